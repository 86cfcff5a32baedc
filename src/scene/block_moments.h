// Where in a map's blocks its occupied voxels lie.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

// Weighted sums over points.
struct Moments {
  double count = 0, weight = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   // of p, in m
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // of p p^T

  void Add(const Moments& other);
};

// The moments of the occupied voxels' centres, in the map's frame: what was hit often counts more.
// Only the blocks that somebody asks for are ever looked at. One thread.
class BlockMoments {
 public:
  // The map must outlive this and stay as it is.
  explicit BlockMoments(const VoxelMap& map) : map_(&map) {}

  struct OfBlock {
    Moments whole;
    std::array<Moments, 8> octants;  // x + 2 y + 4 z
  };
  // Null if nothing is occupied in it. Valid as long as this.
  const OfBlock* Find(BlockKey block);

  const VoxelGrid& grid() const { return map_->grid(); }

 private:
  const OfBlock* FindOrAdd(BlockKey block);  // what Find does not remember

  const VoxelMap* map_;
  std::deque<OfBlock> sums_;
  absl::flat_hash_map<BlockKey, const OfBlock*> found_;
  // Of those asked for last, by the lowest bits of their keys: cells near each other ask for the
  // same ones.
  struct Recent {
    BlockKey block;
    const OfBlock* sums;
    bool asked = false;
  };
  std::array<Recent, 64> recent_;
};

}  // namespace clearway
