#include "io/assimp_import.h"

#include <assimp/BaseImporter.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>
#include <new>
#include <set>
#include <vector>

#include "absl/strings/str_cat.h"
#include "io/imported_mesh.h"
#include "io/mesh_builder.h"
#include "io/mesh_content.h"
#include "io/mesh_io_system.h"

namespace clearway {
namespace {

constexpr int kMaxNodeDepth = 1000;
constexpr float kSliver = 1e-3F;  // a triangle's height over its longest edge

// Gathers the triangles of a scene. Vertices are joined over all its meshes: assimp keeps them
// apart where their normals or colours differ.
class SceneReader {
 public:
  SceneReader(const aiScene& scene, const MeshFileOptions& options)
      : scene_(scene), options_(options), builder_(options.max_triangles) {}

  absl::StatusOr<Mesh> Read() {
    const absl::Status status = AddNode(*scene_.mRootNode, aiMatrix4x4(), 0);
    if (!status.ok()) return status;
    return builder_.Finish();
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
    bool has_faces = false, has_area = false;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      if (part.mFaces[i].mNumIndices != 3) continue;  // points and lines
      has_faces = true;
      const absl::StatusOr<bool> added = AddFace(part, i, vertices, mirrored);
      if (!added.ok()) return added.status();
      has_area = has_area || *added;
    }
    if (has_area || !has_faces) return absl::OkStatus();
    return absl::InvalidArgumentError(  // a part would be lost
        absl::StrCat("mesh '", part.mName.C_Str(), "' has no triangle with an area"));
  }

  // Whether it has an area.
  absl::StatusOr<bool> AddFace(const aiMesh& part, unsigned i,
                               const std::vector<Eigen::Vector3d>& vertices, bool mirrored) {
    const unsigned* const corners = part.mFaces[i].mIndices;
    if (std::max({corners[0], corners[1], corners[2]}) >= vertices.size()) {
      return absl::InvalidArgumentError(absl::StrCat("face ", i, " of mesh '", part.mName.C_Str(),
                                                     "' names a vertex that is not there"));
    }
    const Eigen::Vector3d& b = vertices[corners[mirrored ? 2 : 1]];
    const Eigen::Vector3d& c = vertices[corners[mirrored ? 1 : 2]];
    absl::StatusOr<bool> added = builder_.Add(vertices[corners[0]], b, c);
    if (!added.ok() || *added || !IsWide(part, corners)) return added;
    return absl::InvalidArgumentError(absl::StrCat(
        "face ", i, " of mesh '", part.mName.C_Str(),
        "' loses its area where its node places it: it is too far away, or scaled by 0"));
  }

  // Whether it is no sliver, which rounding may close, before its node places it.
  static bool IsWide(const aiMesh& part, const unsigned* corners) {
    const aiVector3D ab = part.mVertices[corners[1]] - part.mVertices[corners[0]];
    const aiVector3D ac = part.mVertices[corners[2]] - part.mVertices[corners[0]];
    const float longest =
        std::max({ab.SquareLength(), ac.SquareLength(), (ac - ab).SquareLength()});
    return (ab ^ ac).Length() > kSliver * longest;
  }

  const aiScene& scene_;
  const MeshFileOptions& options_;
  MeshBuilder builder_;
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

// Assimp keeps what its importers throw.
bool RanOutOfMemory(const Assimp::Importer& importer) {
  if (!importer.GetException()) return false;
  try {
    std::rethrow_exception(importer.GetException());
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace

absl::StatusOr<Mesh> ImportByAssimp(const std::filesystem::path& path, const std::string& extension,
                                    const std::string& bytes, const MeshFileOptions& options) {
  const absl::StatusOr<MeshContent> content = CheckMeshContent(extension, bytes);
  if (!content.ok()) return content.status();
  Assimp::Importer importer;
  KeepImportersFor(extension.substr(1), importer);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, !options.collada_y_up);
  const auto files = new MeshIoSystem(path, content->reduced ? *content->reduced : bytes,
                                      content->buffers, options.max_bytes);
  importer.SetIOHandler(files);  // which it owns from now on
  const aiScene* scene = importer.ReadFile(path.string(), aiProcess_ValidateDataStructure);
  if (!files->status().ok()) return files->status();
  if (scene != nullptr && scene->mRootNode != nullptr) {
    if (const auto status = CheckImported(*scene, *content); !status.ok()) return status;
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  }
  if (RanOutOfMemory(importer)) {
    return absl::ResourceExhaustedError("assimp takes more memory than its limit");
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    return absl::InvalidArgumentError(absl::StrCat("cannot be read: ", importer.GetErrorString()));
  }
  return SceneReader(*scene, options).Read();
}

}  // namespace clearway
