#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/parse_number.h"
#include "io/collada_geometry.h"
#include "io/collada_text.h"
#include "io/collada_writer.h"
#include "io/mesh_content.h"
#include "io/mesh_lines.h"
#include "io/text_lines.h"

namespace clearway {
namespace {

using Node = pugi::xml_node;

constexpr int kMaxDepth = 1000;
constexpr int kMaxNodes = 100'000;

// Finds the elements that have an id, and what is not supported anywhere.
class Ids : public pugi::xml_tree_walker {
 public:
  explicit Ids(ColladaText& text) : text_(text) {}

  bool for_each(Node& node) override {
    if (depth() > kMaxDepth) text_.Refuse(node, "elements nest too deep");
    const std::string_view name = node.name(), around = node.parent().name();
    if (around == "asset" && (name == "unit" || name == "up_axis")) {
      text_.Refuse(node, "parts with a unit or an up-axis of their own are not supported");
    }
    for (const char* const kind :
         {"geometry", "source", "float_array", "vertices", "node", "visual_scene"}) {
      if (name == "geometry" && !node.attribute("id")) text_.Refuse(node, "it has no id");
      if (name != kind || !node.attribute("id")) continue;
      const std::string id = node.attribute("id").value();
      if (text_.by_id.emplace(absl::StrCat(kind, "#", id), node).second) continue;
      text_.Refuse(node, "another one has the same id");
    }
    return text_.error.ok();
  }

 private:
  ColladaText& text_;
};

// Walks from the scene to the geometries, and writes what is on the way into a file without
// anything else: without materials, cameras, animations, and so on. All nodes become one level.
class Content {
 public:
  explicit Content(std::string_view bytes) { text_.bytes = bytes; }

  absl::StatusOr<MeshContent> Check() {
    const auto parsed = text_.document.load_buffer(text_.bytes.data(), text_.bytes.size());
    if (!parsed) {
      const auto end = std::min(static_cast<std::size_t>(parsed.offset), text_.bytes.size());
      return absl::InvalidArgumentError(
          absl::StrCat("line ", 1 + std::ranges::count(text_.bytes.substr(0, end), '\n'), ": ",
                       parsed.description()));
    }
    const Node root = text_.document.document_element();
    const std::string version = root.attribute("version").value();
    if (std::string_view(root.name()) != "COLLADA" ||
        !(version.starts_with("1.4") || version.starts_with("1.5"))) {
      text_.Refuse(root, "expected <COLLADA> of version 1.4 or 1.5");
    }
    text_.RefuseDoubledAttributes();
    FindIds(root);
    ReadAsset(text_.Only(root, "asset"));
    ReadScene(root);
    for (const auto& [key, node] : text_.by_id) CheckShown(key, node);
    if (content_.faces == 0) text_.error.Set("", "it has no faces");
    if (!text_.error.ok()) return text_.error.status();
    content_.reduced = reduced_.Text();
    return std::move(content_);
  }

 private:
  void FindIds(Node root) {
    Ids ids(text_);
    for (const char* const name :
         {"library_geometries", "library_nodes", "library_visual_scenes"}) {
      for (Node library : root.children(name)) library.traverse(ids);
    }
  }

  void ReadAsset(Node asset) {
    const Node unit = text_.Only(asset, "unit");
    const std::string metres = unit.attribute("meter").as_string("1");
    double metres_per_unit = 0;
    if (!ParseNumber(metres, metres_per_unit) || !(metres_per_unit > 0) ||
        !std::isfinite(metres_per_unit)) {
      text_.Refuse(unit, absl::StrCat("meter is ", Quoted(metres), "; it must be above 0"));
    }
    const Node up_axis = text_.Only(asset, "up_axis");
    const std::string up = up_axis ? std::string(Trimmed(text_.Text(up_axis))) : "Y_UP";
    if (up != "X_UP" && up != "Y_UP" && up != "Z_UP") {
      text_.Refuse(up_axis, "it must be X_UP, Y_UP or Z_UP");
    }
    reduced_.SetAsset(metres_per_unit, up);
  }

  void ReadScene(Node root) {
    const Node instance = text_.Only(text_.Only(root, "scene"), "instance_visual_scene");
    if (!instance) return text_.Refuse(root, "it has no <scene> with an <instance_visual_scene>");
    AddNode(text_.Referred(instance, "url", "visual_scene"), Eigen::Affine3d::Identity(), 0);
  }

  void AddNode(Node node, const Eigen::Affine3d& T_root_parent, int depth) {
    if (depth > kMaxDepth || ++nodes_ > kMaxNodes) {
      text_.Refuse(node, absl::StrCat("nodes nest deeper than ", kMaxDepth,
                                      ", or they and their "
                                      "instances are more than ",
                                      kMaxNodes));
    }
    Eigen::Affine3d T_root_node = T_root_parent;
    for (const Node child : node.children()) {
      if (child.type() == pugi::node_element) AddTransform(child, T_root_node);
    }
    for (const Node child : node.children()) {
      if (!text_.error.ok()) return;
      const std::string_view name = child.name();
      if (name == "node") AddNode(child, T_root_node, depth + 1);
      if (name == "instance_node") {
        AddNode(text_.Referred(child, "url", "node"), T_root_node, depth + 1);
      }
      if (name == "instance_geometry") {
        AddGeometry(text_.Referred(child, "url", "geometry"), T_root_node);
      }
    }
  }

  void AddTransform(Node child, Eigen::Affine3d& T_root_node) {
    const std::string_view name = child.name();
    if (name == "matrix") {
      using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
      const Matrix matrix(text_.Numbers(child, 16).data());
      if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
        text_.Refuse(child, "its last row must be 0 0 0 1");
      }
      T_root_node = T_root_node * Eigen::Affine3d(matrix);
    } else if (name == "translate") {
      T_root_node.translate(Eigen::Vector3d(text_.Numbers(child, 3).data()));
    } else if (name == "scale") {
      T_root_node.scale(Eigen::Vector3d(text_.Numbers(child, 3).data()));
    } else if (name == "rotate") {
      const std::vector<double> numbers = text_.Numbers(child, 4);
      const Eigen::Vector3d axis(numbers.data());
      if (axis.norm() == 0 && numbers[3] == 0) return;
      if (axis.norm() == 0) text_.Refuse(child, "its axis has no length");
      const double angle_rad = numbers[3] * std::numbers::pi / 180;
      T_root_node.rotate(Eigen::AngleAxisd(angle_rad, axis.normalized()));
    } else if (!IsReadElsewhereOrIgnored(name)) {
      text_.Refuse(child, "it is not supported");
    }
  }

  static bool IsReadElsewhereOrIgnored(std::string_view name) {
    constexpr std::string_view kNames[] = {
        "node",  "instance_node", "instance_geometry", "instance_camera", "instance_light",
        "asset", "extra",         "evaluate_scene"};
    return std::ranges::find(kNames, name) != std::end(kNames);
  }

  void AddGeometry(Node geometry, const Eigen::Affine3d& T_root_node) {
    if (!geometry) return;
    const std::string id = geometry.attribute("id").value();
    const auto [it, fresh] = has_faces_.try_emplace(id, false);
    if (fresh) {
      const ColladaFaces faces = ReadColladaGeometry(text_, geometry);
      it->second = !faces.sizes.empty();
      content_.faces = *content_.faces + faces.sizes.size();
      if (it->second) reduced_.AddGeometry(id, faces);
    }
    if (!T_root_node.matrix().allFinite()) text_.Refuse(geometry, "its place is too far away");
    if (it->second) reduced_.AddInstance(id, T_root_node);
  }

  // A file whose scene leaves something out may have lost it.
  void CheckShown(const std::string& key, Node node) {
    if (!key.starts_with("geometry#") || has_faces_.contains(key.substr(9))) return;
    text_.Refuse(node,
                 "no node of the scene has it: a part seems to be missing (if not, remove "
                 "it)");
  }

  ColladaText text_;
  ColladaWriter reduced_;
  std::map<std::string, bool> has_faces_;  // of geometries in the scene, by id
  int nodes_ = 0;
  MeshContent content_ = {.faces = 0, .parts = {}, .buffers = {}, .reduced = {}};
};

}  // namespace

absl::StatusOr<MeshContent> CheckDaeContent(std::string_view bytes) {
  return Content(bytes).Check();
}

}  // namespace clearway
