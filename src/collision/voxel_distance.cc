#include "collision/voxel_distance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "clearway/geometry/distance.h"
#include "collision/cube_bounds.h"
#include "collision/voxel_search.h"

namespace clearway {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

Aabb BoxOfBlock(const VoxelGrid& grid, BlockKey key) {
  Aabb box = grid.BoxOf(VoxelAt(key, 0));
  box.max = grid.BoxOf(VoxelAt(key, kVoxelsPerBlock - 1)).max;
  return box;
}

// Lowers nearest_m by the voxels of one block.
template <class Counts>
void SearchBlock(const VoxelGrid& grid, BlockKey block_key, const BlockMask& voxels,
                 const PlacedShape& shape, Counts&& counts, double& nearest_m) {
  voxels.ForEach([&](int index) {
    const VoxelKey key = VoxelAt(block_key, index);
    const Aabb box = grid.BoxOf(key);
    if (BoxBoxDistance(shape.box_F(), box) >= nearest_m || !counts(key)) return;
    nearest_m = std::min(nearest_m, shape.DistanceTo(box, nearest_m));
  });
}

// A cube of 2^level blocks along an edge.
struct Cell {
  double bound_m;
  int level;
  BlockKey min;
  bool operator>(const Cell& other) const {
    return std::tie(bound_m, level, min) > std::tie(other.bound_m, other.level, other.min);
  }
};

Aabb BoxOfCell(const VoxelGrid& grid, BlockKey min, int level) {
  const std::int32_t last = (1 << level) - 1;
  Aabb box = BoxOfBlock(grid, min);
  box.max = BoxOfBlock(grid, {min.x + last, min.y + last, min.z + last}).max;
  return box;
}

// The centres of the cell's voxels span this.
Aabb CentersOf(const VoxelGrid& grid, Aabb cell) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * grid.resolution_m());
  return {cell.min + half, cell.max - half};
}

// Whether the boxes from `next` on cover `inner` together: what sticks out of the first that meets
// it has to be covered by those after it. Takes steps from `effort` and gives up, with false, when
// they are used up.
bool Cover(const std::vector<Aabb>& boxes, std::size_t next, const Aabb& inner, int& effort) {
  if (--effort < 0) return false;
  while (next < boxes.size() && !boxes[next].Intersects(inner)) ++next;
  if (next == boxes.size()) return false;
  const Aabb& box = boxes[next];
  Aabb rest = inner;  // shrinks to the part inside the box
  for (int axis = 0; axis < 3; ++axis) {
    if (rest.min[axis] < box.min[axis]) {
      Aabb below = rest;
      below.max[axis] = rest.min[axis] = box.min[axis];
      if (!Cover(boxes, next + 1, below, effort)) return false;
    }
    if (rest.max[axis] > box.max[axis]) {
      Aabb above = rest;
      above.min[axis] = rest.max[axis] = box.max[axis];
      if (!Cover(boxes, next + 1, above, effort)) return false;
    }
  }
  return true;
}

bool Covered(const std::vector<Aabb>& boxes, const Aabb& inner) {
  int effort = 100;
  return Cover(boxes, 0, inner, effort);
}

// For the voxel nearest to a shape among blocks with occupied voxels.
class OccupiedSearch {
 public:
  OccupiedSearch(const VoxelGrid& grid, const PlacedShape& shape, double up_to_m)
      : grid_(grid),
        half_voxel_m_(0.5 * grid.resolution_m()),
        half_block_m_(kBlockSize * half_voxel_m_),
        shape_(shape),
        bounds_(shape),
        nearest_m_(std::nextafter(up_to_m, kFar)),
        at_most_m_(nearest_m_) {
    constexpr std::size_t kMostly = 128;  // there are not more
    blocks_.reserve(kMostly);
    voxels_.reserve(kMostly);
  }

  void AddBlock(BlockKey key, const VoxelBlock& block) {
    blocks_.push_back({0, key, &block});
    cubes_.Add(grid_.BoxOf(VoxelAt(key, 0)).min.array() + half_block_m_);
    if (cubes_.count == BoundedCubes::kMost) BoundLast(half_block_m_, blocks_);
  }

  double Nearest_m() {
    BoundLast(half_block_m_, blocks_);
    NearerFirst(blocks_, [&](const Block& block) { AddVoxels(block); });
    NearerFirst(voxels_, [&](const Voxel& voxel) { Measure(voxel); });
    return nearest_m_;
  }

 private:
  struct Block {
    double least_m;
    BlockKey key;
    const VoxelBlock* block;
  };
  struct Voxel {
    double least_m;
    VoxelKey key;
  };

  // Sets the bounds of the last ones, whose cubes are waiting.
  template <class Bounded>
  void BoundLast(double half_edge_m, std::vector<Bounded>& all) {
    bounds_.Bound(half_edge_m, cubes_);
    Bounded* last = all.data() + all.size() - cubes_.count;
    for (std::size_t i = 0; i < cubes_.count; ++i) last[i].least_m = cubes_.least_m[i];
    cubes_.count = 0;
  }

  // Calls visit for those that may hold or be the nearest voxel.
  template <class Bounded, class Visit>
  void NearerFirst(std::vector<Bounded>& all, Visit&& visit) {
    const auto later = [](const Bounded& a, const Bounded& b) { return a.least_m > b.least_m; };
    std::erase_if(all, [&](const Bounded& one) { return one.least_m >= at_most_m_; });
    std::make_heap(all.begin(), all.end(), later);
    for (auto end = all.end(); end != all.begin() && all.front().least_m < at_most_m_; --end) {
      visit(all.front());
      std::pop_heap(all.begin(), end, later);
    }
  }

  void AddVoxels(const Block& block) {
    const std::size_t before = voxels_.size();
    block.block->occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block.key, index);
      voxels_.push_back({0, key});
      cubes_.Add(grid_.CenterOf(key));
    });
    const auto first_most = cubes_.most_m.begin();
    const auto end_most = first_most + static_cast<std::ptrdiff_t>(cubes_.count);
    BoundLast(half_voxel_m_, voxels_);
    const double most_m = *std::min_element(first_most, end_most);
    at_most_m_ = std::min(at_most_m_, most_m);
    if (most_m < kFar) return;
    // Of such a shape bounds do not tell how near it is.
    Measure(
        *std::min_element(voxels_.begin() + static_cast<std::ptrdiff_t>(before), voxels_.end(),
                          [](const Voxel& a, const Voxel& b) { return a.least_m < b.least_m; }));
  }

  void Measure(const Voxel& voxel) {
    nearest_m_ = std::min(nearest_m_, shape_.DistanceTo(grid_.BoxOf(voxel.key), nearest_m_));
    at_most_m_ = std::min(at_most_m_, nearest_m_);
  }

  const VoxelGrid& grid_;
  const double half_voxel_m_, half_block_m_;
  const PlacedShape& shape_;
  const CubeBounds bounds_;
  double nearest_m_;  // of the voxels whose distance is known; above up_to_m without one
  double at_most_m_;  // what the nearest one's distance cannot exceed
  std::vector<Block> blocks_;
  std::vector<Voxel> voxels_;
  BoundedCubes cubes_;  // of the last blocks or voxels
};

}  // namespace

// Bounds first, of blocks and then of voxels, as they cost little; distances only of those voxels
// that may be the nearest.
double DistanceToOccupied(const VoxelMap& map, const PlacedShape& shape, double up_to_m) {
  KeyRange keys;
  if (!KeysTouching(map.grid(), shape.box_F().Padded(up_to_m), keys)) return kFar;
  OccupiedSearch search(map.grid(), shape, up_to_m);
  map.blocks().AnyOccupiedIn(BlockOf(keys.min), BlockOf(keys.max),
                             [&](BlockKey key, const VoxelBlock& block) {
                               search.AddBlock(key, block);
                               return false;
                             });
  return search.Nearest_m();
}

// Best first through an implicit octree over all addressable blocks: a region never observed has no
// end, but its nearest part is found after a few descents; regions declared free, by however many
// boxes, are cut off whole.
double DistanceToUnobserved(const VoxelMap& map, const PlacedShape& shape,
                            const std::vector<Aabb>& known_free, double up_to_m,
                            const Cancelled& cancelled) {
  constexpr int kRootLevel =
      std::countr_zero(static_cast<unsigned>(2 * kMaxVoxelIndex / kBlockSize));
  constexpr std::int32_t kLowest = -kMaxVoxelIndex / kBlockSize;
  const VoxelGrid& grid = map.grid();
  const auto counts = [&](VoxelKey key) { return !InOneOf(known_free, grid.CenterOf(key)); };
  double nearest_m = std::nextafter(up_to_m, kFar);
  std::priority_queue<Cell, std::vector<Cell>, std::greater<>> open;
  open.push({0, kRootLevel, {kLowest, kLowest, kLowest}});
  while (!open.empty() && open.top().bound_m < nearest_m && !cancelled()) {
    const Cell cell = open.top();
    open.pop();
    if (cell.level == 0) {
      SearchBlock(grid, cell.min, UnobservedIn(map.blocks().Find(cell.min)), shape, counts,
                  nearest_m);
      continue;
    }
    const int level = cell.level - 1;
    for (int child = 0; child < 8; ++child) {
      const BlockKey min{cell.min.x + ((child & 1) << level),
                         cell.min.y + ((child >> 1 & 1) << level),
                         cell.min.z + ((child >> 2) << level)};
      const Aabb box = BoxOfCell(grid, min, level);
      const double bound_m = BoxBoxDistance(shape.box_F(), box);
      if (bound_m >= nearest_m || Covered(known_free, CentersOf(grid, box))) continue;
      open.push({bound_m, level, min});
    }
  }
  return nearest_m;
}

}  // namespace clearway
