#include "collision/unknown_share.h"

#include <cstdint>
#include <set>

#include "collision/cube_contact.h"
#include "collision/voxel_search.h"

namespace clearway {
namespace {

constexpr double kRounding_m = 1e-9;

struct Count {
  std::int64_t all = 0;
  std::int64_t unknown = 0;
  double Share() const { return static_cast<double>(unknown) / static_cast<double>(all); }
};

// Whether a voxel in the boxes of the shapes was never observed: if none was, nothing has to be
// counted.
bool AnyUnobserved(const VoxelMap& map, const std::vector<const PlacedShape*>& shapes,
                   const Cancelled& cancelled) {
  for (const PlacedShape* shape : shapes) {
    KeyRange keys;
    if (!KeysTouching(map.grid(), shape->box_F(), keys)) continue;
    const bool any =
        AnyBlock(map.blocks(), BlockOf(keys.min), BlockOf(keys.max),
                 [&](BlockKey key, const VoxelBlock* block) {
                   if (block == nullptr) return true;
                   return RangeInBlock(key, keys).All().Subtract(block->observed).Any();
                 });
    if (any || cancelled()) return true;
  }
  return false;
}

// Each voxel is counted with the first of the shapes that holds its centre.
Count CountInside(const VoxelMap& map, const std::vector<Aabb>& known_free,
                  const std::vector<const PlacedShape*>& shapes, const Cancelled& cancelled) {
  Count count;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto counted_before = [&](const Eigen::Vector3d& center) {
      for (std::size_t j = 0; j < i; ++j) {
        if (shapes[j]->box_F().Contains(center) && shapes[j]->Contains(center)) return true;
      }
      return false;
    };
    KeyRange keys;
    if (!KeysTouching(map.grid(), shapes[i]->box_F(), keys)) continue;
    const CubeContact contact(*shapes[i], 0);
    const double half_block_m = 0.5 * kBlockSize * map.grid().resolution_m();
    AnyBlock(map.blocks(), BlockOf(keys.min), BlockOf(keys.max),
             [&](BlockKey block_key, const VoxelBlock* block) {
               const Eigen::Vector3d middle =
                   map.grid().CenterOf(VoxelAt(block_key, 0)) +
                   Eigen::Vector3d::Constant(half_block_m - 0.5 * map.grid().resolution_m());
               if (contact.Of(middle, half_block_m) == CubeContact::Answer::kNo) return false;
               const BlockMask unobserved = UnobservedIn(block);
               RangeInBlock(block_key, keys).All().ForEach([&](int index) {
                 const Eigen::Vector3d center = map.grid().CenterOf(VoxelAt(block_key, index));
                 if (!shapes[i]->Contains(center) || counted_before(center)) return;
                 ++count.all;
                 count.unknown += unobserved.Test(index) && !InOneOf(known_free, center);
               });
               return cancelled();
             });
  }
  return count;
}

Count CountAtCenters(const VoxelMap& map, const std::vector<Aabb>& known_free,
                     const std::vector<const PlacedShape*>& shapes) {
  std::set<VoxelKey> keys;
  for (const PlacedShape* shape : shapes) keys.insert(map.grid().KeyOf(shape->Center_F()));
  Count count;
  for (const VoxelKey& key : keys) {
    ++count.all;
    count.unknown +=
        map.State(key) == VoxelState::kUnknown && !InOneOf(known_free, map.grid().CenterOf(key));
  }
  return count;
}

// What voxels may be counted, and which surely are, while shapes move within their margins.
class LooseCount {
 public:
  LooseCount(const VoxelMap& map, const std::vector<Aabb>& known_free,
             const std::vector<LooseShape>& shapes)
      : map_(map), known_free_(known_free), shapes_(shapes) {
    for (const auto& [shape, margin_m] : shapes) perhaps_.emplace_back(shape, margin_m);
  }

  void Add(std::size_t shape, const Cancelled& cancelled) {
    const auto& [placed, margin_m] = shapes_[shape];
    const VoxelGrid& grid = map_.grid();
    KeyRange keys;
    if (!KeysTouching(grid, placed.box_F().Padded(margin_m), keys)) return;
    const double half_block_m = 0.5 * kBlockSize * grid.resolution_m();
    AnyBlock(map_.blocks(), BlockOf(keys.min), BlockOf(keys.max),
             [&](BlockKey key, const VoxelBlock* block) {
               const Eigen::Vector3d middle =
                   grid.BoxOf(VoxelAt(key, 0)).min.array() + half_block_m;
               if (perhaps_[shape].Of(middle, half_block_m) == CubeContact::Answer::kNo) {
                 return false;
               }
               const BlockMask unobserved = UnobservedIn(block);
               RangeInBlock(key, keys).All().ForEach([&](int index) {
                 AddVoxel(shape, grid.CenterOf(VoxelAt(key, index)), unobserved.Test(index));
               });
               return cancelled();
             });
  }

  double MostShare() const {
    return known_ == 0 ? 1 : static_cast<double>(unknown_) / static_cast<double>(unknown_ + known_);
  }

 private:
  // Each is counted with the first shape that it may be counted with, or surely is.
  void AddVoxel(std::size_t shape, const Eigen::Vector3d& center, bool unobserved) {
    const bool unknown = unobserved && !InOneOf(known_free_, center);
    const auto is_in = [&](std::size_t i) {
      return unknown ? MayHold(i, center) : shapes_[i].shape_W.Holds(center, shapes_[i].margin_m);
    };
    if (!is_in(shape)) return;
    for (std::size_t i = 0; i < shape; ++i) {
      if (is_in(i)) return;
    }
    ++(unknown ? unknown_ : known_);
  }

  bool MayHold(std::size_t i, const Eigen::Vector3d& center) const {
    const CubeContact::Answer answer = perhaps_[i].Of(center, 0);
    if (answer != CubeContact::Answer::kOpen) return answer == CubeContact::Answer::kYes;
    const auto& [shape, margin_m] = shapes_[i];
    return shape.DistanceToBall(center, 0, margin_m) <= margin_m + kRounding_m;
  }

  const VoxelMap& map_;
  const std::vector<Aabb>& known_free_;
  const std::vector<LooseShape>& shapes_;
  std::vector<CubeContact> perhaps_;
  std::int64_t known_ = 0, unknown_ = 0;
};

}  // namespace

double UnknownShareOf(const VoxelMap& map_W, const std::vector<Aabb>& known_free_W,
                      const std::vector<const PlacedShape*>& shapes_W, const Cancelled& cancelled) {
  if (!AnyUnobserved(map_W, shapes_W, cancelled)) return 0;
  const Count inside = CountInside(map_W, known_free_W, shapes_W, cancelled);
  return inside.all > 0 ? inside.Share() : CountAtCenters(map_W, known_free_W, shapes_W).Share();
}

double MostUnknownShareOf(const VoxelMap& map_W, const std::vector<Aabb>& known_free_W,
                          const std::vector<LooseShape>& shapes_W, const Cancelled& cancelled) {
  LooseCount count(map_W, known_free_W, shapes_W);
  for (std::size_t i = 0; i < shapes_W.size(); ++i) count.Add(i, cancelled);
  return count.MostShare();
}

}  // namespace clearway
