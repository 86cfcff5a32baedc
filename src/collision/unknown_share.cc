#include "collision/unknown_share.h"

#include <cstdint>
#include <set>

#include "collision/cube_contact.h"
#include "collision/voxel_search.h"

namespace clearway {
namespace {

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

}  // namespace

double UnknownShareOf(const VoxelMap& map_W, const std::vector<Aabb>& known_free_W,
                      const std::vector<const PlacedShape*>& shapes_W, const Cancelled& cancelled) {
  if (!AnyUnobserved(map_W, shapes_W, cancelled)) return 0;
  const Count inside = CountInside(map_W, known_free_W, shapes_W, cancelled);
  return inside.all > 0 ? inside.Share() : CountAtCenters(map_W, known_free_W, shapes_W).Share();
}

}  // namespace clearway
