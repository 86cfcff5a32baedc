#include "collision/voxel_contact.h"

#include <array>
#include <bit>

#include "collision/cube_contact.h"
#include "collision/voxel_distance.h"

namespace clearway {
namespace {

constexpr int kOctantSize = kBlockSize / 2;  // voxels along an edge of an eighth of a block

// In a layer of a block: the quarter x + 2 y.
constexpr std::uint64_t Quarter(int number) {
  return std::uint64_t{0x0f0f0f0f} << kOctantSize * (number & 1) << 32 * (number >> 1);
}

// std::popcount is a call where the processor's own instruction may not be used.
int CountOf(std::uint64_t bits) {
  bits -= bits >> 1 & 0x5555'5555'5555'5555;
  bits = (bits & 0x3333'3333'3333'3333) + (bits >> 2 & 0x3333'3333'3333'3333);
  bits = (bits + (bits >> 4)) & 0x0f0f'0f0f'0f0f'0f0f;
  return static_cast<int>(bits * 0x0101'0101'0101'0101 >> 56);
}

// Asks from large to small: a block, its octants, their voxels.
class Search {
 public:
  Search(const VoxelGrid& grid, const PlacedShape& shape, double margin_m)
      : grid_(grid), shape_(shape), margin_m_(margin_m), contact_(shape, margin_m) {}

  // Whether one of the block's voxels that are marked touches the shape.
  bool Touches(BlockKey block, const BlockMask& voxels) const {
    unsigned layers = 0;        // bit z: whether a voxel of that layer is marked
    std::uint64_t columns = 0;  // those in which one is
    for (int z = 0; z < kBlockSize; ++z) {
      layers |= static_cast<unsigned>(voxels.words[z] != 0) << z;
      columns |= voxels.words[z];
    }
    if (layers == 0) return false;
    constexpr int kFewPlaces = 128;  // columns times layers: there are at most so many voxels
    if (CountOf(columns) * CountOf(layers) <= kFewPlaces) {
      return TouchesAny(block, voxels, layers, ~std::uint64_t{0});
    }
    const VoxelKey base = VoxelAt(block, 0);
    for (int octant = 0; octant < 8; ++octant) {
      const std::uint64_t quarter = Quarter(octant & 3);
      const int half = octant >> 2;
      const unsigned layers_of_half = layers & 0xfu << kOctantSize * half;
      if (layers_of_half == 0 || (columns & quarter) == 0) continue;
      const VoxelKey corner{base.x + kOctantSize * (octant & 1),
                            base.y + kOctantSize * (octant >> 1 & 1), base.z + kOctantSize * half};
      if (Misses(corner, kOctantSize)) continue;
      if (TouchesAny(block, voxels, layers_of_half, quarter)) return true;
    }
    return false;
  }

  // Surely none of the block's voxels touches.
  bool Misses(BlockKey block) const { return Misses(VoxelAt(block, 0), kBlockSize); }

 private:
  // Of the marked voxels in some layers, and there in a part.
  bool TouchesAny(BlockKey block, const BlockMask& voxels, unsigned layers,
                  std::uint64_t part) const {
    for (; layers != 0; layers &= layers - 1) {
      const int z = std::countr_zero(layers);
      for (std::uint64_t word = voxels.words[z] & part; word != 0; word &= word - 1) {
        if (TouchesVoxel(VoxelAt(block, z * 64 + std::countr_zero(word)))) return true;
      }
    }
    return false;
  }

  bool TouchesVoxel(VoxelKey key) const {
    switch (contact_.Of(grid_.CenterOf(key), 0.5 * grid_.resolution_m())) {
      case CubeContact::Answer::kNo:
        return false;
      case CubeContact::Answer::kYes:
        return true;
      case CubeContact::Answer::kOpen:
        return shape_.DistanceTo(grid_.BoxOf(key), margin_m_) <= margin_m_;
    }
    return true;
  }

  // Surely none of the cube's voxels touches.
  bool Misses(VoxelKey corner, int edge) const {
    const double half_edge_m = 0.5 * edge * grid_.resolution_m();
    const Eigen::Vector3d center =
        grid_.resolution_m() * Eigen::Vector3d(corner.x, corner.y, corner.z) +
        Eigen::Vector3d::Constant(half_edge_m);
    return contact_.Of(center, half_edge_m) == CubeContact::Answer::kNo;
  }

  const VoxelGrid& grid_;
  const PlacedShape& shape_;
  double margin_m_;
  CubeContact contact_;
};

}  // namespace

bool TouchesOccupied(const VoxelMap& map, const PlacedShape& shape, double margin_m) {
  KeyRange keys;
  if (!KeysTouching(map.grid(), shape.box_F().Padded(margin_m), keys)) return false;
  const Search search(map.grid(), shape, margin_m);
  return map.blocks().AnyOccupiedIn(BlockOf(keys.min), BlockOf(keys.max),
                                    [&](BlockKey key, const VoxelBlock& block) {
                                      __builtin_prefetch(&block.occupied);
                                      if (search.Misses(key)) return false;
                                      const RangeInBlock range(key, keys);
                                      return search.Touches(key, range.Of(block.occupied));
                                    });
}

bool TouchesUnobserved(const VoxelMap& map, const PlacedShape& shape,
                       const std::vector<Aabb>& known_free, double margin_m,
                       const Cancelled& cancelled) {
  constexpr double kMostBlocks = 1 << 16;  // to be looked at one by one
  KeyRange keys;
  if (!KeysTouching(map.grid(), shape.box_F().Padded(margin_m), keys)) return false;
  const BlockKey first = BlockOf(keys.min), last = BlockOf(keys.max);
  if ((last.x - first.x + 1.0) * (last.y - first.y + 1.0) * (last.z - first.z + 1.0) >
      kMostBlocks) {
    return DistanceToUnobserved(map, shape, known_free, margin_m, cancelled) <= margin_m;
  }
  const Search search(map.grid(), shape, margin_m);
  return AnyBlock(map.blocks(), first, last, [&](BlockKey key, const VoxelBlock* block) {
    if (search.Misses(key)) return false;
    BlockMask voxels = RangeInBlock(key, keys).All();
    for (int z = 0; z < kBlockSize; ++z) {
      if (block != nullptr) voxels.words[z] &= ~block->observed.words[z];
    }
    if (!known_free.empty() && voxels.Any()) {
      if (cancelled()) return true;
      const BlockMask candidates = voxels;
      candidates.ForEach([&](int index) {
        if (InOneOf(known_free, map.grid().CenterOf(VoxelAt(key, index)))) voxels.Clear(index);
      });
    }
    return search.Touches(key, voxels);
  });
}

}  // namespace clearway
