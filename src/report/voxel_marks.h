// Marks of the voxels of a box.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "clearway/geometry/aabb.h"
#include "clearway/geometry/pose.h"
#include "clearway/geometry/shape.h"
#include "clearway/map/voxel_key.h"

namespace clearway {

// A mark for each voxel that meets a box in W, none at first; voxels elsewhere have none. One
// thread.
class VoxelMarks {
 public:
  // An empty box holds no voxel; else see CanLookThrough.
  VoxelMarks(const VoxelGrid& grid, const Aabb& box_W);

  // Those whose centre lies in a closed convex surface in O, told by NearHull, a row at a time.
  void MarkHull(const Mesh& hull_O, const Pose& T_O_W);
  // Those for whose centre holds(p_W).
  template <class Holds>
  void MarkIf(Holds&& holds) {
    ForEach([&](VoxelKey key) { marks_[IndexOf(key)] |= holds(grid_.CenterOf(key)); });
  }

  bool AtOrBeside(VoxelKey key) const;
  template <class Visit>
  void ForEachMarked(Visit&& visit) const {
    ForEach([&](VoxelKey key) {
      if (marks_[IndexOf(key)]) visit(key);
    });
  }

 private:
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (VoxelKey key = min_; key.z <= max_.z; ++key.z) {
      for (key.y = min_.y; key.y <= max_.y; ++key.y) {
        for (key.x = min_.x; key.x <= max_.x; ++key.x) visit(key);
      }
    }
  }
  bool Holds(VoxelKey key, std::int32_t padding) const;
  std::size_t IndexOf(VoxelKey key) const;

  VoxelGrid grid_;
  VoxelKey min_{0, 0, 0}, max_{-1, -1, -1};
  std::vector<char> marks_;
};

}  // namespace clearway
