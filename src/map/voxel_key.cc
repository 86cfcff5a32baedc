#include "clearway/map/voxel_key.h"

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

void VoxelGrid::KeysOf(std::span<const Eigen::Vector3d> points, VoxelKey* keys) const {
  if (points.empty()) return;
  IndicesOf(points[0].data(), 3 * points.size(), voxels_per_m_, &keys->x);
}

void VoxelGrid::KeysOf(std::span<const Eigen::Vector3f> points, VoxelKey* keys) const {
  if (points.empty()) return;
  IndicesOf(points[0].data(), 3 * points.size(), voxels_per_m_, &keys->x);
}

}  // namespace clearway
