// Rays into a window of bits, each voxel with as little work as may be.
#pragma once

#include <Eigen/Core>
#include <span>

#include "clearway/map/voxel_key.h"
#include "map/bit_window.h"

namespace clearway {

// A ray, in the grid's frame.
struct RaySegment {
  Eigen::Vector3f origin, end;
};

// The axis of the largest component.
int MainAxis(const Eigen::Vector3f& direction);

// Sets the bits of the voxels that WalkRay visits on the rays; the window must cover them. All rays
// must have the same main axis and the same sign along it.
void MarkRays(const VoxelGrid& grid, std::span<const RaySegment> rays, BitWindow& window);

}  // namespace clearway
