// Bounds of the distances between a shape and many cubes of one size.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "clearway/map/voxel_block.h"
#include "collision/cube_contact.h"
#include "collision/narrowphase.h"

namespace clearway {

// Cubes by their centres in F, and between what their distances lie.
struct BoundedCubes {
  static constexpr std::size_t kMost = kVoxelsPerBlock;

  std::size_t count = 0;  // as the first so many entries hold; at most kMost
  std::array<double, kMost> x_m, y_m, z_m;
  std::array<double, kMost> least_m, most_m;  // once bounded

  void Add(const Eigen::Vector3d& center_F) {
    x_m[count] = center_F.x();
    y_m[count] = center_F.y();
    z_m[count] = center_F.z();
    ++count;
  }
};

// Refers to the shape.
class CubeBounds {
 public:
  explicit CubeBounds(const PlacedShape& shape);

  // What CubeContact::DistanceTo says of each, many at a time where the shape is a box or a line
  // with a radius.
  void Bound(double half_edge_m, BoundedCubes& cubes) const;

 private:
  CubeContact one_by_one_;
  std::optional<TurnedBox> box_;  // a line is a box without width
  double radius_m_ = 0;
};

}  // namespace clearway
