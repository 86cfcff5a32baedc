// Integer addresses of voxels and of the 8x8x8 blocks that store them.
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <span>
#include <utility>

#include "clearway/geometry/aabb.h"

namespace clearway {

// Voxels are addressable in [-kMaxVoxelIndex, kMaxVoxelIndex) along each axis: 104 km at 0.1 m.
inline constexpr std::int32_t kMaxVoxelIndex = 1 << 20;
inline constexpr int kBlockBits = 3;
inline constexpr int kBlockSize = 1 << kBlockBits;  // voxels along an edge of a block

// A voxel's address: voxel (i, j, k) spans [i, i + 1) x [j, j + 1) x [k, k + 1) times the
// resolution.
struct VoxelKey {
  std::int32_t x = 0, y = 0, z = 0;
  auto operator<=>(const VoxelKey&) const = default;

  template <class H>
  friend H AbslHashValue(H h, const VoxelKey& key) {
    return H::combine(std::move(h), key.x, key.y, key.z);
  }
};

// A block's address: block (i, j, k) holds the voxels [8 i, 8 i + 8) x ...
struct BlockKey {
  std::int32_t x = 0, y = 0, z = 0;
  auto operator<=>(const BlockKey&) const = default;

  template <class H>
  friend H AbslHashValue(H h, const BlockKey& key) {
    return H::combine(std::move(h), key.x, key.y, key.z);
  }
};

constexpr BlockKey BlockOf(VoxelKey key) {
  return {key.x >> kBlockBits, key.y >> kBlockBits, key.z >> kBlockBits};
}

// The place of a voxel in its block: x + 8 y + 64 z of its offsets, 0 to 511.
constexpr int IndexInBlock(VoxelKey key) {
  return (key.x & 7) | (key.y & 7) << 3 | (key.z & 7) << 6;
}

constexpr VoxelKey VoxelAt(BlockKey block, int index) {
  return {block.x * kBlockSize + (index & 7), block.y * kBlockSize + (index >> 3 & 7),
          block.z * kBlockSize + (index >> 6)};
}

constexpr bool InRange(VoxelKey key) {
  const auto ok = [](std::int32_t i) { return i >= -kMaxVoxelIndex && i < kMaxVoxelIndex; };
  return ok(key.x) && ok(key.y) && ok(key.z);
}

// The voxels from `first` to `last` along each axis, both among them.
struct VoxelRange {
  VoxelKey first, last;

  // 0 if `last` comes before `first` along any axis.
  std::uint64_t count() const;
  bool Contains(VoxelKey key) const {
    return key.x >= first.x && key.x <= last.x && key.y >= first.y && key.y <= last.y &&
           key.z >= first.z && key.z <= last.z;
  }
};

// The regular grid that voxels lie on: origin at the frame's origin, edges of `resolution_m`. A
// value. The arithmetic is OctoMap's (coordToKey, keyToCoord), so that keys agree bit for bit.
class VoxelGrid {
 public:
  // resolution_m > 0.
  explicit VoxelGrid(double resolution_m)
      : resolution_m_(resolution_m), voxels_per_m_(1.0 / resolution_m) {}

  double resolution_m() const { return resolution_m_; }
  double voxels_per_m() const { return voxels_per_m_; }
  // The largest coordinate that every point of the grid may have, in metres.
  double limit_m() const { return resolution_m_ * (kMaxVoxelIndex - 1); }

  // The voxel that holds p; each |coordinate| must be at most limit_m().
  VoxelKey KeyOf(const Eigen::Vector3d& p) const {
    return {Index(p.x()), Index(p.y()), Index(p.z())};
  }
  // The same for many points: keys[i] of points[i].
  void KeysOf(std::span<const Eigen::Vector3d> points, VoxelKey* keys) const;
  void KeysOf(std::span<const Eigen::Vector3f> points, VoxelKey* keys) const;
  Eigen::Vector3d CenterOf(VoxelKey key) const {
    return {Center(key.x), Center(key.y), Center(key.z)};
  }
  double Center(std::int32_t index) const { return (index + 0.5) * resolution_m_; }
  Aabb BoxOf(VoxelKey key) const {
    return {resolution_m_ * Eigen::Vector3d(key.x, key.y, key.z),
            resolution_m_ * Eigen::Vector3d(key.x + 1.0, key.y + 1.0, key.z + 1.0)};
  }
  // The voxels whose centre lies in the box, or beside it by at most a millionth of a voxel: 0.25
  // m is the centre of a voxel of 0.1 m, though neither number is exact.
  VoxelRange CentersIn(const Aabb& box) const;
  // False for NaN and infinity too.
  bool Addressable(const Eigen::Vector3d& p) const { return (p.array().abs() <= limit_m()).all(); }
  bool operator==(const VoxelGrid&) const = default;

 private:
  // Rounds down, without the library's call that std::floor is on the smallest x86-64.
  std::int32_t Index(double coordinate) const {
    const double position = voxels_per_m_ * coordinate;
    const auto toward_zero = static_cast<std::int32_t>(position);
    return toward_zero - static_cast<std::int32_t>(position < toward_zero);
  }

  double resolution_m_;
  double voxels_per_m_;
};

}  // namespace clearway
