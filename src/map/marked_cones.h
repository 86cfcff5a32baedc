// How far from a sensor everything is marked already.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "base/lanes.h"
#include "clearway/map/voxel_key.h"
#include "map/bit_window.h"

namespace clearway {

// The directions from one origin near an axis (its component is the largest) in small cones. Of
// each cone it finds up to which depth, the distance along the axis, all its voxels are marked in a
// window: rays of the cone have nothing to add there. Where a wide cone is marked, the narrow ones
// in it need no look. Marks are only ever added, so that depths grow. Not thread-safe.
class MarkedCones {
 public:
  static constexpr int kLevels = 3;  // narrow cones, four of them in one, and four of those

  // Directions whose component along `main_axis` is negative, or not; `across` narrow cones, a
  // multiple of 2^kLevels, along each of the other two axes.
  MarkedCones(const VoxelGrid& grid, const Eigen::Vector3d& origin, int main_axis, bool negative,
              int across);

  // Of eight rays in direction[x, y, z]: all voxels that each passes before its depth, in metres,
  // are marked in the window. Looks at most once a round for each cone.
  void FindDepths(const LaneFloats (&direction)[3], const BitWindow& window, LaneDoubles& depths_m);
  // More has been marked: look again.
  void NextRound() { ++round_; }

 private:
  struct Cone {
    int layers = 0;     // of voxels along the main axis that are marked, the origin's the first
    int looked_in = 0;  // what round
  };
  // Cones of one width.
  struct Level {
    explicit Level(int the_across) : across(the_across), cones(the_across * the_across) {}
    int across;
    std::vector<Cone> cones;
  };

  // Distance along the main axis from the origin to where a layer begins, in voxels.
  double LayerBegin(int layer) const { return layer == 0 ? 0 : first_layer_ + (layer - 1); }
  // The marked layers of cone (b, c) of a level.
  int Layers(int level, int b, int c, const BitWindow& window);
  // Whether all of the cone's voxels in a layer are marked.
  struct Slopes;
  bool LayerMarked(int layer, const Slopes& b, const Slopes& c, const BitWindow& window) const;

  double resolution_m_;
  std::array<double, 3> origin_;  // in voxels
  std::array<std::int32_t, 3> origin_voxel_;
  int axis_, b_, c_;  // the main axis and the others
  std::int32_t sign_;
  double first_layer_;  // how much of the origin's voxel lies ahead, in voxels
  int round_ = 1;
  std::vector<Level> levels_;  // the narrow ones first
};

}  // namespace clearway
