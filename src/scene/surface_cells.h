// The surface of an object's map, smooth enough to register views to.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

// Normal distributions of occupied voxels in cubic cells (P. Biber, W. Strasser, "The Normal
// Distributions Transform", IROS 2003). A cell's distribution is of its own voxels and of those in
// the 26 cells around it, so that neighbours are alike and there is one in every cell beside an
// occupied one. What was hit often counts more. Along a surface it tells hardly anything: that the
// voxels of a cell lie in that cell is no news. One thread.
class SurfaceCells {
 public:
  struct Cell {
    Eigen::Vector3d mean_O;
    // Three vectors a_i, in 1/m: a point p is sum (a_i (p - mean_O))^2 squared deviations away.
    std::array<Eigen::Vector3d, 3> factors;

    double Deviation(const Eigen::Vector3d& p_O, int i) const {
      return factors[i].dot(p_O - mean_O);
    }
  };

  // Edges of 2^bits voxels, of which a block is a multiple.
  SurfaceCells(const VoxelMap& map_O, int bits);

  // The one that holds p; null where hardly anything is near. Valid until the next call.
  const Cell* At(const Eigen::Vector3d& p_O);

 private:
  // Weighted by log-odds.
  struct Sums {
    double count = 0, weight = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

    void Add(double of_weight, const Eigen::Vector3d& p);
    void Add(const Sums& other);
  };
  std::optional<Cell> CellAround(BlockKey key) const;
  static Cell CellOf(const Sums& sums, double voxel_m);

  double voxel_m_, per_m_;
  absl::flat_hash_map<BlockKey, Sums> sums_;                 // of the cells with occupied voxels
  absl::flat_hash_map<BlockKey, std::optional<Cell>> seen_;  // those that somebody asked for
};

}  // namespace clearway
