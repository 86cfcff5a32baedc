// How far from a sensor everything is marked already.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "clearway/map/voxel_key.h"
#include "map/bit_window.h"

namespace clearway {

// The directions from one origin near an axis (its component is the largest) in small cones. Of
// each cone it finds up to which depth, the distance along the axis, all its voxels are marked in a
// window: rays of the cone have nothing to add there. Marks are only ever added, so that depths
// grow. Not thread-safe.
class MarkedCones {
 public:
  // Directions whose component along `main_axis` is negative, or not; `across` cones, an even
  // number, along each of the other two axes.
  MarkedCones(const VoxelGrid& grid, const Eigen::Vector3d& origin, int main_axis, bool negative,
              int across);

  // All voxels that a ray in this direction passes before this depth are marked in the window.
  // Metres. Looks at most once a round for each cone.
  double Depth_m(const Eigen::Vector3f& direction, const BitWindow& window);
  // More has been marked: look again.
  void NextRound();

 private:
  struct Cone {
    int layers = 0;  // of voxels along the main axis that are marked, the origin's the first
    bool looked = false;
  };

  // Distance along the main axis from the origin to where a layer begins, in voxels.
  double LayerBegin(int layer) const { return layer == 0 ? 0 : first_layer_ + (layer - 1); }
  void Look(int cone, const BitWindow& window);

  double resolution_m_;
  std::array<double, 3> origin_;  // in voxels
  std::array<std::int32_t, 3> origin_voxel_;
  int axis_, b_, c_;  // the main axis and the others
  std::int32_t sign_;
  int across_;
  double first_layer_;  // how much of the origin's voxel lies ahead, in voxels
  std::vector<Cone> cones_;
};

}  // namespace clearway
