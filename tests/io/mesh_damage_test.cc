// Every damage to one place of a file leaves the mesh whole, is refused, or is noted.
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <sstream>

#include "absl/strings/escaping.h"
#include "clearway/geometry/solid_mesh.h"
#include "io/assimp_import.h"
#include "io/mesh_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kTriangles = 8;

class MeshDamage : public testing::Test {
 protected:
  // Counts what was read, and fails where a part is missing. Reads in this process, as thousands of
  // children take minutes; that the caller survives is tested with fewer files.
  void Try(const std::string& name, const std::string& bytes, const std::string& damage) {
    const auto path = folder_.Write(name, bytes);
    const auto mesh = ImportByAssimp(path, path.extension().string(), bytes, {});
    ++tried_;
    if (!mesh.ok()) {
      EXPECT_FALSE(mesh.status().message().empty());
      return;
    }
    ++read_;
    if (mesh->triangles.size() >= kTriangles) return;
    EXPECT_NE(SolidMeshOf(std::make_shared<const Mesh>(*mesh)).note, "") << damage;
  }

  TemporaryFolder folder_;
  int tried_ = 0, read_ = 0;
};

std::string TextOf(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, "", pugi::format_raw);
  return std::move(out).str();
}

std::vector<pugi::xml_node> ElementsOf(pugi::xml_document& document) {
  struct Walker : pugi::xml_tree_walker {
    std::vector<pugi::xml_node> nodes;
    bool for_each(pugi::xml_node& node) override {
      nodes.push_back(node);
      return true;
    }
  } walker;
  document.traverse(walker);
  return walker.nodes;
}

// Calls with the example once for each of its nodes, and the number of the node.
template <class Function>
void ForEachNode(Function function) {
  pugi::xml_document document;
  document.load_string(Dae().c_str());
  const std::size_t count = ElementsOf(document).size();
  for (std::size_t i = 0; i < count; ++i) {
    pugi::xml_document copy;
    copy.reset(document);
    function(copy, ElementsOf(copy)[i]);
  }
}

TEST_F(MeshDamage, ElementsOfColladaFilesAreRemovedAndDoubled) {
  ForEachNode([&](pugi::xml_document& document, pugi::xml_node node) {
    const std::string path = node.path();
    pugi::xml_document doubled;
    node.parent().insert_copy_after(node, node);
    Try("a.dae", TextOf(document), "doubled: " + path);
    node.parent().remove_child(node.next_sibling());
    node.parent().remove_child(node);
    Try("a.dae", TextOf(document), "removed: " + path);
  });
  EXPECT_GT(tried_, 150);
  EXPECT_GT(read_, 10);
}

TEST_F(MeshDamage, AttributesOfColladaFilesAreChanged) {
  ForEachNode([&](pugi::xml_document& document, pugi::xml_node node) {
    for (pugi::xml_attribute attribute : node.attributes()) {
      const std::string old = attribute.value();
      for (const char* value : {"", "0", "1", "-1", "2", "3", "5", "99", "4294967295", "1e400",
                                "nan", "x", "#x", "#A-mesh", "#B-mesh-normals", "x.dae#A-mesh"}) {
        attribute = value;
        Try("a.dae", TextOf(document), node.path() + "@" + attribute.name() + "=" + value);
      }
      attribute = old.c_str();
    }
  });
  EXPECT_GT(tried_, 1000);
  EXPECT_GT(read_, 100);
}

TEST_F(MeshDamage, WordsOfColladaFilesAreChanged) {
  ForEachNode([&](pugi::xml_document& document, pugi::xml_node node) {
    const std::string old = node.value();
    if (node.type() != pugi::node_pcdata) return;
    for (std::size_t at = 0; at < old.size(); at = old.find_first_of(" \n", at) + 1) {
      const std::size_t end = std::min(old.find_first_of(" \n", at), old.size());
      for (const char* word :
           {"", "0", "1", "-1", "2", "7", "99", "1e400", "nan", "x", "<!-- -->"}) {
        node.set_value((old.substr(0, at) + word + old.substr(end)).c_str());
        Try("a.dae", TextOf(document), node.path() + ": " + node.value());
      }
      if (end == old.size()) break;
    }
  });
  EXPECT_GT(tried_, 1000);
  EXPECT_GT(read_, 100);
}

TEST_F(MeshDamage, ColladaFilesAreCutAtAnyByte) {
  const std::string whole = Dae();
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    Try("a.dae", whole.substr(0, size), "cut");
    EXPECT_EQ(read_, 0) << size;
  }
}

TEST_F(MeshDamage, ValuesOfGltfFilesAreChangedAndRemoved) {
  const Json whole = GltfJson(), flat = whole.flatten();
  std::set<std::string> pointers;  // to all values, those with members too
  for (const auto& [pointer, value] : flat.items()) {
    for (auto p = Json::json_pointer(pointer); !p.empty(); p = p.parent_pointer()) {
      pointers.insert(p.to_string());
    }
  }
  for (const std::string& pointer : pointers) {
    for (const Json& value : {Json(), Json(0), Json(1), Json(2), Json(3), Json(5), Json(9),
                              Json(12), Json(-1), Json(4294967295), Json(1e30), Json("x"),
                              Json(5121), Json(5125), Json(Json::array()), Json(true)}) {
      Json json = whole;
      json[Json::json_pointer(pointer)] = value;
      Try("a.glb", Glb(json), pointer + " = " + value.dump());
    }
    Json json = whole;
    const Json::json_pointer p(pointer);
    Json& parent = json.at(p.parent_pointer());
    if (parent.is_array()) {
      parent.erase(static_cast<std::size_t>(std::stoul(p.back())));
    } else {
      parent.erase(p.back());
    }
    Try("a.glb", Glb(json), "removed: " + pointer);
  }
  EXPECT_GT(tried_, 1500);
  EXPECT_GT(read_, 100);
}

TEST_F(MeshDamage, BytesOfBinaryGltfFilesAreChanged) {
  const std::string whole = Glb(GltfJson());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const char byte : {'\0', '\xff', '"'}) {
      std::string damaged = whole;
      damaged[i] = byte;
      Try("a.glb", damaged, absl::StrCat("byte ", i, ": ", absl::CHexEscape(damaged.substr(i, 1))));
    }
  }
  EXPECT_GT(read_, 200);
}

}  // namespace
}  // namespace clearway
