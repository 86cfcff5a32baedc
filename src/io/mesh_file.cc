#include "clearway/io/mesh_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <new>
#include <set>
#include <tuple>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "io/imported_mesh.h"
#include "io/mesh_content.h"
#include "io/mesh_io_system.h"

namespace clearway {
namespace {

using Path = std::filesystem::path;

// The formats whose importers are simple enough to be given files of unknown origin.
constexpr std::array<const char*, 7> kExtensions = {".stl", ".obj",  ".ply", ".off",
                                                    ".dae", ".gltf", ".glb"};
constexpr int kMaxNodeDepth = 1000;
constexpr float kSliver = 1e-3F;  // a triangle's height over its longest edge

std::string ExtensionOf(const Path& path) {
  return absl::AsciiStrToLower(path.extension().string());
}

absl::Status CheckOptions(const Path& path, const MeshFileOptions& options) {
  if (!(options.scale > 0) || !std::isfinite(options.scale)) {
    return absl::InvalidArgumentError(
        absl::StrCat("scale is ", NumberText(options.scale), "; it must be above 0"));
  }
  const std::string extension = ExtensionOf(path);
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end()) {
    return absl::InvalidArgumentError(absl::StrCat(
        path.string(), ": the extension must be .stl, .obj, .ply, .off, .dae, .gltf or .glb"));
  }
  return absl::OkStatus();
}

// Gathers the triangles of a scene. Vertices with the same coordinates become one, over all meshes:
// assimp keeps them apart where their normals or colours differ.
class MeshBuilder {
 public:
  MeshBuilder(const aiScene& scene, const MeshFileOptions& options)
      : scene_(scene), options_(options) {}

  absl::StatusOr<Mesh> Build() {
    absl::Status status = AddNode(*scene_.mRootNode, aiMatrix4x4(), 0);
    if (!status.ok()) return status;
    if (mesh_.triangles.empty()) {
      return absl::InvalidArgumentError("no triangle with an area");
    }
    return std::move(mesh_);
  }

 private:
  absl::Status AddNode(const aiNode& node, const aiMatrix4x4& T_root_parent, int depth) {
    if (depth > kMaxNodeDepth) return absl::InvalidArgumentError("nodes nest too deep");
    const aiMatrix4x4 T_root_node = T_root_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const absl::Status status = AddMesh(*scene_.mMeshes[node.mMeshes[i]], T_root_node);
      if (!status.ok()) return status;
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      const absl::Status status = AddNode(*node.mChildren[i], T_root_node, depth + 1);
      if (!status.ok()) return status;
    }
    return absl::OkStatus();
  }

  absl::Status AddMesh(const aiMesh& part, const aiMatrix4x4& T_root_node) {
    std::vector<Eigen::Vector3d> vertices;
    vertices.reserve(part.mNumVertices);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      const aiVector3D v = T_root_node * part.mVertices[i];
      vertices.push_back(options_.scale * Eigen::Vector3d(v.x, v.y, v.z));
      if (!vertices.back().allFinite()) {
        return absl::InvalidArgumentError(
            absl::StrCat("vertex ", i, " of mesh '", part.mName.C_Str(), "' is not finite"));
      }
    }
    // A reflection turns triangles inside out.
    const bool mirrored = aiMatrix3x3(T_root_node).Determinant() < 0;
    const std::size_t before = mesh_.triangles.size();
    bool has_faces = false;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      if (part.mFaces[i].mNumIndices != 3) continue;  // points and lines
      has_faces = true;
      const absl::Status status = AddFace(part, i, vertices, mirrored);
      if (!status.ok()) return status;
    }
    if (!has_faces || mesh_.triangles.size() > before) return absl::OkStatus();
    return absl::InvalidArgumentError(  // a part would be lost
        absl::StrCat("mesh '", part.mName.C_Str(), "' has no triangle with an area"));
  }

  absl::Status AddFace(const aiMesh& part, unsigned i, const std::vector<Eigen::Vector3d>& vertices,
                       bool mirrored) {
    const unsigned* const corners = part.mFaces[i].mIndices;
    if (std::max({corners[0], corners[1], corners[2]}) >= vertices.size()) {
      return absl::InvalidArgumentError(absl::StrCat("face ", i, " of mesh '", part.mName.C_Str(),
                                                     "' names a vertex that is not there"));
    }
    const Eigen::Vector3d& a = vertices[corners[0]];
    const Eigen::Vector3d& b = vertices[corners[mirrored ? 2 : 1]];
    const Eigen::Vector3d& c = vertices[corners[mirrored ? 1 : 2]];
    if ((b - a).cross(c - a).norm() > 0) {
      mesh_.triangles.push_back({IndexOf(a), IndexOf(b), IndexOf(c)});
    } else if (IsWide(part, corners)) {
      return absl::InvalidArgumentError(absl::StrCat(
          "face ", i, " of mesh '", part.mName.C_Str(),
          "' loses its area where its node places it: it is too far away, or scaled by 0"));
    }
    if (mesh_.triangles.size() <= options_.max_triangles) return absl::OkStatus();
    return absl::ResourceExhaustedError(
        absl::StrCat("more than ", options_.max_triangles, " triangles, the limit"));
  }

  // Whether it is no sliver, which rounding may close, before its node places it.
  static bool IsWide(const aiMesh& part, const unsigned* corners) {
    const aiVector3D ab = part.mVertices[corners[1]] - part.mVertices[corners[0]];
    const aiVector3D ac = part.mVertices[corners[2]] - part.mVertices[corners[0]];
    const float longest =
        std::max({ab.SquareLength(), ac.SquareLength(), (ac - ab).SquareLength()});
    return (ab ^ ac).Length() > kSliver * longest;
  }

  std::uint32_t IndexOf(const Eigen::Vector3d& p) {
    const auto [it, fresh] = indices_.try_emplace(
        {p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (fresh) mesh_.vertices.push_back(p);
    return it->second;
  }

  const aiScene& scene_;
  const MeshFileOptions& options_;
  Mesh mesh_;
  std::map<std::tuple<double, double, double>, std::uint32_t> indices_;
};

// Assimp goes by the content where the extension's importer refuses a file; that would let in some
// fifty formats more.
void KeepImportersFor(const std::string& extension, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const loader = importer.GetImporter(i);
    std::set<std::string> extensions;
    loader->GetExtensionList(extensions);
    if (extensions.count(extension) > 0) continue;
    importer.UnregisterLoader(loader);
    delete loader;
  }
}

// A byte order mark stands before text only.
absl::Status DropByteOrderMark(const std::string& extension, std::string& bytes) {
  if (extension == ".glb" || (extension == ".stl" && IsWholeBinaryStl(bytes))) {
    return absl::OkStatus();
  }
  const auto text = WithoutByteOrderMark("the file", bytes);
  if (text.ok()) bytes.erase(0, bytes.size() - text->size());
  return text.status();
}

absl::StatusOr<Mesh> Import(const Path& path, std::string bytes, const MeshFileOptions& options) {
  const absl::Status text = DropByteOrderMark(ExtensionOf(path), bytes);
  if (!text.ok()) return text;
  absl::StatusOr<MeshContent> content = CheckMeshContent(ExtensionOf(path), bytes);
  if (!content.ok()) return content.status();
  if (content->reduced) bytes = *std::move(content->reduced);
  Assimp::Importer importer;
  KeepImportersFor(ExtensionOf(path).substr(1), importer);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, !options.collada_y_up);
  const auto files = new MeshIoSystem(path, bytes, content->buffers, options.max_bytes);
  importer.SetIOHandler(files);  // which it owns from now on
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_ValidateDataStructure);
  if (!files->status().ok()) return files->status();
  if (scene != nullptr && scene->mRootNode != nullptr) {
    if (const auto status = CheckImported(*scene, *content); !status.ok()) return status;
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    return absl::InvalidArgumentError(absl::StrCat("cannot be read: ", importer.GetErrorString()));
  }
  return MeshBuilder(*scene, options).Build();
}

}  // namespace

absl::StatusOr<Mesh> ReadMesh(const Path& path, const MeshFileOptions& options) {
  const absl::Status status = CheckOptions(path, options);
  if (!status.ok()) return status;
  absl::StatusOr<std::string> bytes = ReadWholeFile(path, options.max_bytes);
  if (!bytes.ok()) return bytes.status();
  absl::StatusOr<Mesh> mesh = absl::InternalError("");
  try {
    mesh = Import(path, *std::move(bytes), options);
  } catch (const std::bad_alloc&) {
    mesh = absl::ResourceExhaustedError("cannot be read: it takes more memory than there is");
  } catch (const std::exception& error) {  // what assimp does not catch itself
    mesh = absl::InvalidArgumentError(absl::StrCat("cannot be read: assimp: ", error.what()));
  }
  if (mesh.ok()) return mesh;
  return absl::Status(mesh.status().code(),
                      absl::StrCat(path.string(), ": ", std::string(mesh.status().message())));
}

}  // namespace clearway
