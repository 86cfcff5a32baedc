// Against OctoMap's own library.
#include <algorithm>

#include "clearway/io/octomap_file.h"
#include "io/octomap_example.h"

namespace clearway {
namespace {

constexpr OctomapFormat kFormats[] = {OctomapFormat::kBinary, OctomapFormat::kFull};

// OctoMap's tree. Its own prune() ends at the first level, from the voxels up, of which it prunes
// nothing.
class Tree : public octomap::OcTree {
 public:
  using OcTree::OcTree;

  void PruneAllLevels() {
    if (root == nullptr) return;
    unsigned pruned = 0;
    for (unsigned depth = tree_depth - 1; depth > 0; --depth) pruneRecurs(root, 0, depth, pruned);
  }
};

// The data after the header, and how many nodes it has.
struct Body {
  std::string data;
  std::size_t size = 0;
  bool operator==(const Body&) const = default;
};

Body ByOctomap(const VoxelMap& map, OctomapFormat format) {
  Tree tree(map.grid().resolution_m());
  tree.setClampingThresMin(1e-4);  // beyond the map's own
  tree.setClampingThresMax(1 - 1e-4);
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.observed.ForEach([&](int index) {
      const float value = format == OctomapFormat::kFull
                              ? static_cast<float>(Dequantized(block.log_odds[index]))
                              : (block.occupied.Test(index) ? 1.0F : -1.0F);
      tree.setNodeValue(KeyFor(VoxelAt(key, index)), value, /*lazy_eval=*/true);
    });
  });
  tree.updateInnerOccupancy();
  tree.PruneAllLevels();
  std::ostringstream out;
  format == OctomapFormat::kFull ? tree.writeData(out) : tree.writeBinaryData(out);
  return {std::move(out).str(), tree.size()};
}

Body Written(const VoxelMap& map, OctomapFormat format) {
  const std::string bytes = Serialized(map, format), end = "data\n", size = "size ";
  return {bytes.substr(bytes.find(end) + end.size()),
          std::stoul(bytes.substr(bytes.find(size) + size.size()))};
}

// Single voxels and boxes of few values, whole blocks among them, all about.
VoxelMap RandomMap(unsigned seed) {
  VoxelMap map(0.1);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> corner(-80, 60), edge(0, 5), value(0, 3);
  for (int i = 0; i < 40; ++i) {
    const int size = 1 << edge(random);
    const int step = i % 2 == 0 ? size : 1;  // every other box is aligned, and can be pruned
    const VoxelKey low{corner(random) / step * step, corner(random) / step * step,
                       corner(random) / step * step};
    const auto log_odds = static_cast<LogOdds>(4000 * value(random) - 6000);
    for (int k = 0; k < size * size * size; ++k) {
      map.Set({low.x + k % size, low.y + k / size % size, low.z + k / size / size}, log_odds);
    }
  }
  return map;
}

TEST(WriteOctomap, IsWhatOctomapsLibraryWrites) {
  for (const OctomapFormat format : kFormats) {
    EXPECT_EQ(Written(VoxelMap(0.1), format), ByOctomap(VoxelMap(0.1), format));
    EXPECT_EQ(Written(ExampleMap(), format), ByOctomap(ExampleMap(), format));
    for (unsigned seed = 0; seed < 20; ++seed) {
      const VoxelMap map = RandomMap(seed);
      EXPECT_TRUE(Written(map, format) == ByOctomap(map, format)) << seed;
    }
  }
}

TEST(WriteOctomap, ReachesOctomapsBounds) {
  VoxelMap map(0.1);
  for (const std::int32_t i : {-kHalfWidth, kHalfWidth - 1}) {
    map.Set({i, i, i}, map.model().clamp_max);
    map.Set({i, -1, 0}, map.model().clamp_min);
  }
  for (const OctomapFormat format : kFormats) {
    EXPECT_EQ(Written(map, format), ByOctomap(map, format));
  }
}

TEST(WriteOctomap, PiecesAreShort) {
  const VoxelMap map = ExampleMap();
  for (const OctomapFormat format : kFormats) {
    std::string all;
    std::size_t longest = 0;
    const auto take = [&](std::string_view piece) {
      longest = std::max(longest, piece.size());
      all.append(piece);
      return true;
    };
    ASSERT_TRUE(WriteOctomap(map, format, take).ok());
    EXPECT_EQ(all, Serialized(map, format));
    EXPECT_LT(longest, std::size_t{70'000});
  }
}

TEST(WriteOctomap, EndsWhenNobodyWantsMore) {
  const VoxelMap map = RandomMap(1);
  int pieces = 0;
  const auto refuse = [&](std::string_view) { return ++pieces < 2; };
  EXPECT_TRUE(absl::IsCancelled(WriteOctomap(map, OctomapFormat::kFull, refuse)));
  EXPECT_EQ(pieces, 2);
  int asked = 0;
  const auto cancelled = [&] { return ++asked > 1; };
  const auto take = [&](std::string_view) { return true; };
  EXPECT_TRUE(absl::IsCancelled(WriteOctomap(map, OctomapFormat::kFull, take, cancelled)));
}

}  // namespace
}  // namespace clearway
