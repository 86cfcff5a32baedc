#include "io/imported_mesh.h"

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/aabb.h"

namespace clearway {
namespace {

constexpr double kBoundsTolerance = 1e-4;  // of the largest coordinate that they state

// The number of faces of three corners or more.
absl::StatusOr<std::uint64_t> CountFaces(const aiMesh& part) {
  std::uint64_t count = 0;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    if (part.mFaces[i].mNumIndices == 0) {
      return absl::InvalidArgumentError(
          absl::StrCat("face ", i, " of mesh '", part.mName.C_Str(), "' has no vertices"));
    }
    if (part.mFaces[i].mNumIndices > 2) ++count;
  }
  return count;
}

std::string TextOf(const Eigen::Vector3d& v) {
  return absl::StrCat("(", NumberText(v.x()), ", ", NumberText(v.y()), ", ", NumberText(v.z()),
                      ")");
}

absl::Status CheckPart(const aiMesh& part, std::uint64_t faces, const MeshPart& expected) {
  if (faces != expected.faces) {
    return absl::InvalidArgumentError(absl::StrCat(expected.name, ": ", expected.faces - faces,
                                                   " of its ", expected.faces,
                                                   " triangles name vertices that are not there"));
  }
  if (!expected.bounds) return absl::OkStatus();
  Aabb box;
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    box.Extend(Eigen::Vector3d(v.x, v.y, v.z));
  }
  const Aabb& stated = *expected.bounds;
  const double tolerance =
      kBoundsTolerance * stated.min.cwiseAbs().cwiseMax(stated.max.cwiseAbs()).maxCoeff();
  if ((box.min - stated.min).cwiseAbs().maxCoeff() <= tolerance &&
      (box.max - stated.max).cwiseAbs().maxCoeff() <= tolerance) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrCat(
      expected.name, ": its vertices reach from ", TextOf(box.min), " to ", TextOf(box.max),
      "; their accessor states min ", TextOf(stated.min), " and max ", TextOf(stated.max)));
}

}  // namespace

absl::Status CheckImported(const aiScene& scene, const MeshContent& content) {
  std::uint64_t found = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    const absl::StatusOr<std::uint64_t> faces = CountFaces(part);
    if (!faces.ok()) return faces.status();
    found += *faces;
    for (const MeshPart& expected : content.parts) {
      if (expected.name != part.mName.C_Str()) continue;
      if (const auto status = CheckPart(part, *faces, expected); !status.ok()) return status;
    }
  }
  if (!content.faces || found == *content.faces) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("it has ", *content.faces, " faces, of which ", found, " could be read"));
}

}  // namespace clearway
