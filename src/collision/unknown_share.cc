#include "collision/unknown_share.h"

#include <algorithm>
#include <cstdint>
#include <set>

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
bool AnyUnobserved(const VoxelMap& map, const std::vector<Sweep>& shapes,
                   const Cancelled& cancelled) {
  for (const Sweep& shape : shapes) {
    KeyRange keys;
    if (!KeysTouching(map.grid(), shape.Box(), keys)) continue;
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

// Calls visit(BlockKey, const VoxelBlock*, masks) for the blocks near the shapes, each once, with
// the marks of all shapes.
template <class Visit>
void ForEachBlock(const VoxelMap& map, const std::vector<Sweep>& shapes, const Cancelled& cancelled,
                  Visit&& visit) {
  std::vector<CenterMasks> parts;
  parts.reserve(shapes.size());
  for (const Sweep& shape : shapes) parts.emplace_back(map.grid(), shape);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].Empty()) continue;
    AnyBlock(map.blocks(), parts[i].first(), parts[i].last(),
             [&](BlockKey key, const VoxelBlock* block) {
               const auto near = [&](const CenterMasks& part) { return part.Near(key); };
               if (std::any_of(parts.begin(), parts.begin() + i, near)) return false;
               CenterMasks::Masks masks;
               for (std::size_t j = i; j < parts.size(); ++j) {
                 if (near(parts[j])) parts[j].AddTo(key, masks);
               }
               visit(key, block, masks);
               return cancelled();
             });
  }
}

// Of the block's voxels those that count as unknown.
BlockMask UnknownIn(const VoxelMap& map, BlockKey key, const VoxelBlock* block,
                    const std::vector<Aabb>& known_free) {
  BlockMask unknown = UnobservedIn(block);
  if (known_free.empty()) return unknown;
  const BlockMask unobserved = unknown;
  unobserved.ForEach([&](int index) {
    if (InOneOf(known_free, map.grid().CenterOf(VoxelAt(key, index)))) unknown.Clear(index);
  });
  return unknown;
}

int CountOfBoth(const BlockMask& a, const BlockMask& b) {
  BlockMask in_a_alone = a;
  return a.Count() - in_a_alone.Subtract(b).Count();
}

Count CountInside(const VoxelMap& map, const std::vector<Aabb>& known_free,
                  const std::vector<Sweep>& standing, const Cancelled& cancelled) {
  Count count;
  ForEachBlock(map, standing, cancelled,
               [&](BlockKey key, const VoxelBlock* block, const CenterMasks::Masks& masks) {
                 BlockMask inside = masks.surely, unsure = masks.perhaps;
                 unsure.Subtract(inside).ForEach([&](int index) {
                   const Eigen::Vector3d center = map.grid().CenterOf(VoxelAt(key, index));
                   const auto holds = [&](const Sweep& s) { return s.shape_F.Contains(center); };
                   if (std::any_of(standing.begin(), standing.end(), holds)) inside.Set(index);
                 });
                 count.all += inside.Count();
                 count.unknown += CountOfBoth(inside, UnknownIn(map, key, block, known_free));
               });
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

// Whether the centre of a shape may come to lie in an unknown voxel.
bool MayBeCenteredInUnknown(const VoxelMap& map, const std::vector<Aabb>& known_free,
                            const std::vector<Sweep>& sweeps) {
  for (const Sweep& sweep : sweeps) {
    const Eigen::Vector3d center = sweep.shape_F.Center_F();
    Aabb centers{center, center};
    centers.Extend(center + sweep.way_F);
    KeyRange keys;
    if (!KeysTouching(map.grid(), centers.Padded(sweep.LargestMargin()), keys)) return true;
    const bool any =
        AnyBlock(map.blocks(), BlockOf(keys.min), BlockOf(keys.max),
                 [&](BlockKey key, const VoxelBlock* block) {
                   return RangeInBlock(key, keys).Of(UnknownIn(map, key, block, known_free)).Any();
                 });
    if (any) return true;
  }
  return false;
}

}  // namespace

double UnknownShareOf(const VoxelMap& map_W, const std::vector<Aabb>& known_free_W,
                      const std::vector<const PlacedShape*>& shapes_W, const Cancelled& cancelled) {
  std::vector<Sweep> standing;
  standing.reserve(shapes_W.size());
  for (const PlacedShape* shape : shapes_W)
    standing.push_back({*shape, Eigen::Vector3d::Zero(), 0});
  if (!AnyUnobserved(map_W, standing, cancelled)) return 0;
  const Count inside = CountInside(map_W, known_free_W, standing, cancelled);
  return inside.all > 0 ? inside.Share() : CountAtCenters(map_W, known_free_W, shapes_W).Share();
}

double MostUnknownShareOf(const VoxelMap& map_W, const std::vector<Aabb>& known_free_W,
                          const std::vector<Sweep>& sweeps_W, const Cancelled& cancelled) {
  if (!AnyUnobserved(map_W, sweeps_W, cancelled)) return 0;
  std::int64_t unknown = 0, known = 0;
  ForEachBlock(map_W, sweeps_W, cancelled,
               [&](BlockKey key, const VoxelBlock* block, const CenterMasks::Masks& masks) {
                 const BlockMask unknown_here = UnknownIn(map_W, key, block, known_free_W);
                 unknown += CountOfBoth(masks.perhaps, unknown_here);
                 known += masks.surely.Count() - CountOfBoth(masks.surely, unknown_here);
               });
  if (known > 0) return static_cast<double>(unknown) / static_cast<double>(unknown + known);
  return unknown > 0 || MayBeCenteredInUnknown(map_W, known_free_W, sweeps_W) ? 1 : 0;
}

}  // namespace clearway
