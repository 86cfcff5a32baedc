#include "clearway/map/voxel_key.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/multiversion.h"

namespace clearway {
namespace {

// Coordinate by coordinate, as VoxelGrid::Index does.
template <class Scalar>
inline void RoundDown(const Scalar* coordinates, std::size_t count, double voxels_per_m,
                      std::int32_t* indices) {
  for (std::size_t i = 0; i < count; ++i) {
    const double position = voxels_per_m * static_cast<double>(coordinates[i]);
    const auto toward_zero = static_cast<std::int32_t>(position);
    indices[i] = toward_zero - static_cast<std::int32_t>(position < toward_zero);
  }
}

CLEARWAY_MULTIVERSION
void IndicesOf(const double* coordinates, std::size_t count, double voxels_per_m,
               std::int32_t* indices) {
  RoundDown(coordinates, count, voxels_per_m, indices);
}
CLEARWAY_MULTIVERSION
void IndicesOf(const float* coordinates, std::size_t count, double voxels_per_m,
               std::int32_t* indices) {
  RoundDown(coordinates, count, voxels_per_m, indices);
}

// Their coordinates, as one array.
static_assert(sizeof(VoxelKey) == 3 * sizeof(std::int32_t));
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));

}  // namespace

std::uint64_t VoxelRange::count() const {
  std::uint64_t count = 1;
  for (const auto& [from, to] :
       {std::pair{first.x, last.x}, {first.y, last.y}, {first.z, last.z}}) {
    if (to < from) return 0;
    count *= static_cast<std::uint64_t>(to - from + 1);
  }
  return count;
}

VoxelRange VoxelGrid::CentersIn(const Aabb& box) const {
  constexpr double kTolerance = 1e-6;  // of a voxel
  const auto index = [](double position) {
    return static_cast<std::int32_t>(
        std::clamp(position, -1.0 - kMaxVoxelIndex, 1.0 * kMaxVoxelIndex));
  };
  VoxelRange range;
  for (const auto& [from, to, low, high] :
       {std::tuple(&range.first.x, &range.last.x, box.min.x(), box.max.x()),
        std::tuple(&range.first.y, &range.last.y, box.min.y(), box.max.y()),
        std::tuple(&range.first.z, &range.last.z, box.min.z(), box.max.z())}) {
    *from = std::max(-kMaxVoxelIndex, index(std::ceil(voxels_per_m_ * low - 0.5 - kTolerance)));
    *to = std::min(kMaxVoxelIndex - 1, index(std::floor(voxels_per_m_ * high - 0.5 + kTolerance)));
  }
  return range;
}

void VoxelGrid::KeysOf(std::span<const Eigen::Vector3d> points, VoxelKey* keys) const {
  if (points.empty()) return;
  IndicesOf(points[0].data(), 3 * points.size(), voxels_per_m_, &keys->x);
}

void VoxelGrid::KeysOf(std::span<const Eigen::Vector3f> points, VoxelKey* keys) const {
  if (points.empty()) return;
  IndicesOf(points[0].data(), 3 * points.size(), voxels_per_m_, &keys->x);
}

}  // namespace clearway
