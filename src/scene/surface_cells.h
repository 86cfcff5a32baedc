// The surface of a map, smooth enough to register views to.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/voxel_map.h"

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

  // Edges of 2^bits voxels, of which a block is a multiple. `origin` is M's in the map's frame. The
  // map must outlive this and stay as it is.
  SurfaceCells(const VoxelMap& map, int bits, const Eigen::Vector3d& origin);

  // The one that holds p; null where hardly anything is near. Valid until the next call.
  const Cell* At(const Eigen::Vector3d& p_M);

 private:
  // Weighted by log-odds.
  struct Sums {
    double count = 0, weight = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

    void Add(double of_weight, const Eigen::Vector3d& p);
    void Add(const Sums& other);
  };
  // Where in sums_ those of the block's cells begin; kNone if nothing is occupied in it.
  static constexpr std::ptrdiff_t kNone = -1;
  std::ptrdiff_t BeginOf(BlockKey block);
  std::ptrdiff_t FindOrAdd(BlockKey block);  // what BeginOf does not remember
  std::optional<Cell> CellAround(BlockKey key);
  Cell CellOf(const Sums& sums) const;

  const VoxelMap* map_;
  int bits_, shift_;  // of voxels to cells; of cells to blocks
  double voxel_m_, per_m_;
  Eigen::Vector3d origin_;
  std::vector<Sums> sums_;                                // block by block
  absl::flat_hash_map<BlockKey, std::ptrdiff_t> begins_;  // in sums_
  // Of those asked for last, by the lowest bits of their keys: cells near each other ask for the
  // same ones.
  struct Recent {
    BlockKey block;
    std::ptrdiff_t begin = kUnasked;
  };
  static constexpr std::ptrdiff_t kUnasked = -2;
  std::array<Recent, 64> recent_;
  absl::flat_hash_map<BlockKey, std::optional<Cell>> seen_;  // those that somebody asked for
};

}  // namespace clearway
