#include "io/mesh_bytes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Counts {
  std::uint64_t vertices = 0, triangles = 0;
};

static_assert(sizeof(Eigen::Vector3d) == 24 && sizeof(Triangle) == 12 && sizeof(Counts) == 16);

template <class T>
void Append(std::string& bytes, const std::vector<T>& items) {
  bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
}

// The bytes must be those of `count` items at least.
template <class T>
std::vector<T> Take(std::string_view& bytes, std::uint64_t count) {
  std::vector<T> items(count);
  if (count > 0) std::memcpy(static_cast<void*>(items.data()), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return items;
}

// Divides, as products could overflow.
bool IsSizeOf(std::size_t bytes, const Counts& counts) {
  if (counts.vertices > bytes / sizeof(Eigen::Vector3d)) return false;
  const std::size_t rest = bytes - counts.vertices * sizeof(Eigen::Vector3d);
  return rest % sizeof(Triangle) == 0 && rest / sizeof(Triangle) == counts.triangles;
}

}  // namespace

std::string MeshToBytes(const Mesh& mesh) {
  const Counts counts = {mesh.vertices.size(), mesh.triangles.size()};
  std::string bytes;
  bytes.reserve(sizeof counts + counts.vertices * sizeof(Eigen::Vector3d) +
                counts.triangles * sizeof(Triangle));
  bytes.append(reinterpret_cast<const char*>(&counts), sizeof counts);
  Append(bytes, mesh.vertices);
  Append(bytes, mesh.triangles);
  return bytes;
}

absl::StatusOr<Mesh> MeshFromBytes(std::string_view bytes) {
  Counts counts;
  if (bytes.size() < sizeof counts) {
    return absl::InvalidArgumentError(absl::StrCat(bytes.size(), " bytes are no mesh"));
  }
  std::memcpy(&counts, bytes.data(), sizeof counts);
  bytes.remove_prefix(sizeof counts);
  if (!IsSizeOf(bytes.size(), counts)) {
    return absl::InvalidArgumentError(absl::StrCat(bytes.size(), " bytes are not ", counts.vertices,
                                                   " vertices and ", counts.triangles,
                                                   " triangles"));
  }
  Mesh mesh;
  mesh.vertices = Take<Eigen::Vector3d>(bytes, counts.vertices);
  mesh.triangles = Take<Triangle>(bytes, counts.triangles);
  for (const Eigen::Vector3d& vertex : mesh.vertices) {
    if (!vertex.allFinite()) return absl::InvalidArgumentError("a vertex is not finite");
  }
  for (const Triangle& triangle : mesh.triangles) {
    if (*std::ranges::max_element(triangle) < counts.vertices) continue;
    return absl::InvalidArgumentError("a triangle names a vertex that is not there");
  }
  return mesh;
}

std::uint64_t MaxMeshBytes(std::size_t max_triangles) {
  constexpr std::uint64_t kEach = 3 * sizeof(Eigen::Vector3d) + sizeof(Triangle);
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  if (max_triangles > (kMost - sizeof(Counts)) / kEach) return kMost;
  return sizeof(Counts) + kEach * max_triangles;
}

}  // namespace clearway
