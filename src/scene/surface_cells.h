// The surface of a map, smooth enough to register views to.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "absl/container/flat_hash_map.h"
#include "scene/block_moments.h"

namespace clearway {

// Normal distributions of occupied voxels in cubic cells (P. Biber, W. Strasser, "The Normal
// Distributions Transform", IROS 2003). A cell's distribution is of its own voxels and of those in
// the 26 cells around it, so that neighbours are alike and there is one in every cell beside an
// occupied one. What was hit often counts more. Along a surface it tells hardly anything: that the
// voxels of a cell lie in that cell is no news. Only the blocks around the points that somebody
// asks for are ever looked at. Points are given in M: the map's axes, from an origin of one's own.
// One thread.
class SurfaceCells {
 public:
  struct Cell {
    Eigen::Vector3d mean_M;
    // Three vectors a_i, in 1/m: a point p is sum (a_i (p - mean_M))^2 squared deviations away.
    std::array<Eigen::Vector3d, 3> factors;

    double Deviation(const Eigen::Vector3d& p_M, int i) const {
      return factors[i].dot(p_M - mean_M);
    }
  };

  enum class Size { kOctant, kBlock };  // 4 voxels across, or 8

  // `origin` is M's in the map's frame. The moments must outlive this.
  SurfaceCells(BlockMoments& moments, Size size, const Eigen::Vector3d& origin);

  // The one that holds p; null where hardly anything is near. Valid until the next call.
  const Cell* At(const Eigen::Vector3d& p_M);

 private:
  std::optional<Cell> CellAround(BlockKey key);
  Cell CellOf(const Moments& around) const;

  BlockMoments* moments_;
  int shift_;  // of cells to blocks
  double voxel_m_, per_m_;
  Eigen::Vector3d origin_;
  absl::flat_hash_map<BlockKey, std::optional<Cell>> seen_;  // those that somebody asked for
};

}  // namespace clearway
