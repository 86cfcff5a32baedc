#include <Eigen/Core>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "io/first_error.h"
#include "io/gltf_accessors.h"
#include "io/gltf_file.h"
#include "io/gltf_members.h"
#include "io/mesh_content.h"
#include "io/mesh_lines.h"

namespace clearway {
namespace {

using Json = nlohmann::json;

constexpr int kMaxNodeDepth = 1000;

// What these change is seen or read, not touched.
bool IsAboutLooks(const std::string& extension) {
  for (const char* const start :
       {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_xmp"}) {
    if (absl::StartsWith(extension, start)) return true;
  }
  return false;
}

// Walks from the scene to the buffers, and writes what is on the way into a file without anything
// else: without materials, cameras, animations, and so on.
class Content {
 public:
  explicit Content(GltfFile file)
      : file_(std::move(file)),
        members_(file_.json, error_),
        accessors_(file_, error_, reduced_),
        nodes_seen_(Size("nodes")),
        meshes_used_(Size("meshes")) {}

  absl::StatusOr<MeshContent> Check() {
    CheckAsset();
    reduced_["asset"] = {{"version", "2.0"}};
    reduced_["nodes"] = Json::array();
    for (std::size_t i = 0; i < Size("meshes"); ++i) reduced_["meshes"].push_back(Json::object());
    for (const Json& node : members_.List(Scene(), "the scene", "nodes")) {
      AddNode(members_.Index(node, "the scene", "nodes"), Eigen::Matrix4d::Identity(), 0);
    }
    CheckAllShown();
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < reduced_["nodes"].size(); ++i) all.push_back(i);
    reduced_["scene"] = 0;
    reduced_["scenes"] = {{{"nodes", all}}};
    if (content_.faces == 0) error_.Set("", "it has no triangles");
    if (!error_.ok()) return error_.status();
    file_.json = std::move(reduced_);
    content_.reduced = GltfBytes(file_);
    content_.buffers = accessors_.files();
    return std::move(content_);
  }

 private:
  std::size_t Size(const char* list) const { return members_.List(file_.json, "", list).size(); }

  void CheckAsset() {
    const Json& version = GltfMembers::Get(members_.Object(file_.json, "", "asset"), "version");
    if (!version.is_string() || !absl::StartsWith(version.get<std::string>(), "2.")) {
      error_.Set("asset.version",
                 absl::StrCat("is ", Quoted(version.dump()), "; only version 2 of glTF is read"));
    }
    for (const Json& extension : members_.List(file_.json, "", "extensionsRequired")) {
      if (extension.is_string() && IsAboutLooks(extension.get<std::string>())) continue;
      error_.Set("extensionsRequired", absl::StrCat(extension.dump().substr(0, 80),
                                                    " is not supported: export without it"));
    }
  }

  const Json& Scene() {
    if (!file_.json.contains("scene") && Size("scenes") > 1) {
      error_.Set("scene", absl::StrCat("is missing, though there are ", Size("scenes"), " scenes"));
    }
    const Json number = file_.json.contains("scene") ? file_.json["scene"] : Json(0u);
    return members_.Element(members_.Index(number, "scene", "scenes"), "scenes");
  }

  void AddNode(std::uint64_t n, const Eigen::Matrix4d& T_root_parent, int depth) {
    const std::string place = absl::StrCat("nodes[", n, "]");
    if (depth > kMaxNodeDepth) error_.Set(place, "nodes nest too deep");
    if (!error_.ok()) return;
    if (nodes_seen_[n]) error_.Set(place, "the scene has it twice");
    nodes_seen_[n] = true;
    const Json& node = members_.Element(n, "nodes");
    const Eigen::Matrix4d T_root_node = T_root_parent * members_.Transform(node, place);
    if (members_.Object(node, place, "extensions").contains("EXT_mesh_gpu_instancing")) {
      error_.Set(place, "EXT_mesh_gpu_instancing is not supported: export without it");
    }
    if (node.contains("mesh")) AddMesh(node, place, T_root_node);
    for (const Json& child : members_.List(node, place, "children")) {
      AddNode(members_.Index(child, place, "nodes"), T_root_node, depth + 1);
    }
  }

  void AddMesh(const Json& node, const std::string& place, const Eigen::Matrix4d& T_root_node) {
    const std::uint64_t m = members_.Index(node["mesh"], place, "meshes");
    if (!error_.ok()) return;
    if (node.contains("skin")) {
      error_.Set(place, "skins are not supported: apply the armature before you export");
    }
    CheckWeights(node, place);
    if (!meshes_used_[m]) UseMesh(m);
    meshes_used_[m] = true;
    if (!T_root_node.allFinite()) error_.Set(place, "its numbers are too large");
    const std::vector<double> matrix(T_root_node.data(), T_root_node.data() + 16);
    reduced_["nodes"].push_back({{"mesh", m}, {"matrix", matrix}});
  }

  // Of shapes that vertices move to; a weight of 0 leaves them where they are.
  void CheckWeights(const Json& object, const std::string& place) {
    for (const Json& weight : members_.List(object, place, "weights")) {
      if (weight != 0) error_.Set(place, "weights of morph targets must be 0: apply shape keys");
    }
  }

  void UseMesh(std::uint64_t m) {
    const std::string place = absl::StrCat("meshes[", m, "]");
    const Json& mesh = members_.Element(m, "meshes");
    CheckWeights(mesh, place);
    const Json& primitives = members_.List(mesh, place, "primitives");
    if (primitives.empty()) error_.Set(place, "it has no primitives");
    Json reduced = Json::array();
    std::vector<MeshPart> parts;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      UsePrimitive(primitives[p], absl::StrCat(place, ".primitives[", p, "]"), reduced, parts);
    }
    reduced_["meshes"][m] = {{"name", place}, {"primitives", reduced}};
    for (std::size_t p = 0; p < parts.size(); ++p) {
      parts[p].name = parts.size() == 1 ? place : absl::StrCat(place, "-", p);
      content_.faces = content_.faces.value_or(0) + parts[p].faces;
      content_.parts.push_back(parts[p]);
    }
  }

  void UsePrimitive(const Json& primitive, const std::string& place, Json& reduced,
                    std::vector<MeshPart>& parts) {
    if (!primitive.is_object()) return error_.Set(place, "must be an object");
    const Json& attributes = members_.Object(primitive, place, "attributes");
    for (const Json& accessor : attributes) accessors_.Mark(accessor);
    for (const Json& target : members_.List(primitive, place, "targets")) {
      for (const Json& accessor : target) accessors_.Mark(accessor);
    }
    const std::uint64_t mode = members_.WholeOr(primitive, place, "mode", 4);
    if (mode < 4 || mode > 6) {
      error_.Set(place, absl::StrCat("mode is ", mode,
                                     "; only 4, 5 and 6 are read: export "
                                     "triangles, without points and lines"));
    }
    if (!attributes.contains("POSITION")) error_.Set(place, "it has no POSITION");
    if (!error_.ok()) return;
    const std::uint64_t positions = members_.Index(attributes["POSITION"], place, "accessors");
    Json copy = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
    std::uint64_t corners = accessors_.Use(positions, GltfAccessors::Positions());
    if (primitive.contains("indices")) {
      copy["indices"] = members_.Index(primitive["indices"], place, "accessors");
      corners = accessors_.Use(copy["indices"].get<std::uint64_t>(), GltfAccessors::Indices());
    }
    if (corners < 3 || (mode == 4 && corners % 3 != 0)) {
      error_.Set(place, absl::StrCat(corners, " corners make no triangles"));
    }
    if (!error_.ok()) return;
    reduced.push_back(std::move(copy));
    parts.push_back({"", mode == 4 ? corners / 3 : corners - 2, BoundsOf(positions)});
  }

  std::optional<Aabb> BoundsOf(std::uint64_t positions) {
    const std::string place = absl::StrCat("accessors[", positions, "]");
    const Json& accessor = members_.Element(positions, "accessors");
    if (!accessor.contains("min") || !accessor.contains("max")) return std::nullopt;
    Aabb box;
    box.min = Eigen::Vector3d(members_.Numbers(accessor, place, "min", 3).data());
    box.max = Eigen::Vector3d(members_.Numbers(accessor, place, "max", 3).data());
    return box;
  }

  // A file whose scene leaves something out may have lost it.
  void CheckAllShown() {
    for (std::size_t n = 0; n < nodes_seen_.size(); ++n) {
      if (nodes_seen_[n] || !members_.Element(n, "nodes").contains("mesh")) continue;
      error_.Set(absl::StrCat("nodes[", n, "]"),
                 "it has a mesh, but is not in the scene: a part seems to be missing "
                 "(if not, remove it)");
    }
    const auto unused = std::ranges::find(meshes_used_, false);
    if (unused != meshes_used_.end()) {
      error_.Set(absl::StrCat("meshes[", unused - meshes_used_.begin(), "]"),
                 "no node of the scene has it: a part seems to be missing (if not, remove it)");
    }
    for (const Json& animation : members_.List(file_.json, "", "animations")) {
      for (const Json& sampler : GltfMembers::Get(animation, "samplers")) {
        accessors_.Mark(GltfMembers::Get(sampler, "input"));
        accessors_.Mark(GltfMembers::Get(sampler, "output"));
      }
    }
    for (const Json& skin : members_.List(file_.json, "", "skins")) {
      accessors_.Mark(GltfMembers::Get(skin, "inverseBindMatrices"));
    }
    accessors_.CheckAllMarked();
    accessors_.CheckViewsCovered();
  }

  GltfFile file_;
  FirstError error_;
  Json reduced_ = Json::object();
  GltfMembers members_;
  GltfAccessors accessors_;
  std::vector<bool> nodes_seen_, meshes_used_;
  MeshContent content_ = {.faces = 0, .parts = {}, .buffers = {}, .reduced = {}};
};

}  // namespace

absl::StatusOr<MeshContent> CheckGltfContent(std::string_view bytes) {
  absl::StatusOr<GltfFile> file = ReadGltf(bytes);
  if (!file.ok()) return file.status();
  return Content(*std::move(file)).Check();
}

absl::StatusOr<MeshContent> CheckGlbContent(std::string_view bytes) {
  absl::StatusOr<GltfFile> file = ReadGlb(bytes);
  if (!file.ok()) return file.status();
  return Content(*std::move(file)).Check();
}

}  // namespace clearway
