// The rays of a scan that run in similar directions.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <vector>

#include "map/bit_window.h"
#include "map/mark_rays.h"

namespace clearway {

// A part of a cloud's rays with a window of its own, so that threads can walk different sectors at
// once. Keeps its memory from one cloud to the next. One thread at a time.
class RaySector {
 public:
  // A sector is told by the axis and sign of the direction's largest component, and by the sign of
  // another one: eight sectors look to the sides, two up and two down.
  static constexpr int kCount = 12;
  static int IndexOf(const Eigen::Vector3f& direction) {
    const int main_axis = MainAxis(direction);
    const int other_axis = main_axis == 0 ? 1 : 0;
    return 4 * main_axis + 2 * (direction[main_axis] < 0) + (direction[other_axis] < 0);
  }

  void Clear();
  void Add(const RaySegment& ray) {
    if (ray.origin != ray.end) rays_.Add(ray);  // else WalkRay visits nothing
  }
  std::size_t size() const { return rays_.size(); }

  // Walks the rays: the voxels that WalkRay visits, by blocks, each block once. Valid until Clear.
  // Takes the blocks from `left`, which other sectors take from at the same time; below 0 there
  // were too many, and some may be missing.
  const std::vector<BitWindow::Block>& Mark(const VoxelGrid& grid, std::atomic<std::int64_t>& left);

 private:
  void MarkInWindow(const VoxelGrid& grid, const RayBoxes& boxes, BlockKey first, BlockKey last);
  // Without a window, which would be too large. Stops once nothing is left.
  void MarkSparsely(const VoxelGrid& grid, std::atomic<std::int64_t>& left);

  RayRounds rays_;
  BitWindow window_;
  std::vector<BitWindow::Block> blocks_;
};

}  // namespace clearway
