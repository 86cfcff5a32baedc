#include "map/ray_sector.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "clearway/map/ray.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

const VoxelGrid kGrid(0.1);

// The voxels of the blocks, each of which must be there once, with something in it.
std::set<VoxelKey> VoxelsOf(const std::vector<BitWindow::Block>& blocks) {
  std::set<BlockKey> keys;
  std::set<VoxelKey> voxels;
  for (const BitWindow::Block& block : blocks) {
    EXPECT_TRUE(keys.insert(block.key).second);
    EXPECT_TRUE(block.mask.Any());
    block.mask.ForEach([&](int i) { voxels.insert(VoxelAt(block.key, i)); });
  }
  return voxels;
}

std::set<VoxelKey> Walked(const std::vector<RaySegment>& rays) {
  std::set<VoxelKey> voxels;
  for (const RaySegment& ray : rays) {
    WalkRay(kGrid, ray.origin, ray.end, [&](VoxelKey key) { voxels.insert(key); });
  }
  return voxels;
}

// Rays of one sector: along x above all, and to the left.
std::vector<RaySegment> RaysAhead(std::size_t count, float length_m, Random& random) {
  std::vector<RaySegment> rays;
  const Eigen::Vector3f origin = random.Vector(2).cast<float>();
  while (rays.size() < count) {
    Eigen::Vector3f direction = random.UnitVector().cast<float>();
    if (RaySector::IndexOf(direction) != 0) continue;
    rays.push_back({origin, origin + length_m * direction});
  }
  return rays;
}

void Fill(const std::vector<RaySegment>& rays, RaySector& dut) {
  dut.Clear();
  for (const RaySegment& ray : rays) dut.Add(ray);
}

// Of rays that are few enough.
const std::vector<BitWindow::Block>& Mark(RaySector& dut) {
  std::atomic<std::int64_t> left = 1 << 20;
  const auto& blocks = dut.Mark(kGrid, left);
  EXPECT_EQ(left, (1 << 20) - static_cast<std::int64_t>(blocks.size()));
  return blocks;
}

TEST(RaySector, TwelveSectorsByTheMainAxisAndTwoSigns) {
  std::set<int> seen;
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3f direction = random.UnitVector().cast<float>();
    const int index = RaySector::IndexOf(direction);
    EXPECT_EQ(RaySector::IndexOf(7 * direction), index);
    EXPECT_NE(RaySector::IndexOf(-direction), index);
    seen.insert(index);
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(RaySector::kCount));
  EXPECT_EQ(*seen.begin(), 0);
  EXPECT_EQ(*seen.rbegin(), RaySector::kCount - 1);
}

TEST(RaySector, MarksWhatWalksVisitCloudAfterCloud) {
  Random random(2);
  RaySector dut;
  for (const std::size_t count : {1, 700, 20, 3000}) {
    const std::vector<RaySegment> rays = RaysAhead(count, 8, random);
    Fill(rays, dut);
    EXPECT_EQ(dut.size(), count);
    EXPECT_EQ(VoxelsOf(Mark(dut)), Walked(rays));
  }
}

// Too far for a window.
TEST(RaySector, MarksRaysOfAnyLength) {
  Random random(3);
  const std::vector<RaySegment> rays = RaysAhead(5, 3000, random);
  const auto block_of = [](const Eigen::Vector3f& p) {
    return BlockOf(kGrid.KeyOf(p.cast<double>()));
  };
  Eigen::AlignedBox3f box;
  for (const RaySegment& ray : rays) box.extend(ray.origin).extend(ray.end);
  ASSERT_FALSE(BitWindow::Fits(block_of(box.min()), block_of(box.max())));
  RaySector dut;
  Fill(rays, dut);
  EXPECT_EQ(VoxelsOf(Mark(dut)), Walked(rays));
}

// With a window and without.
TEST(RaySector, TakesNoMoreBlocksThanAreLeftAndOne) {
  Random random(4);
  RaySector dut;
  for (const float length_m : {8.0f, 3000.0f}) {
    const std::vector<RaySegment> rays = RaysAhead(5, length_m, random);
    Fill(rays, dut);
    const auto needed = static_cast<std::int64_t>(Mark(dut).size());
    for (const std::int64_t spare : {0, -1}) {
      Fill(rays, dut);
      std::atomic<std::int64_t> left = needed + spare;
      EXPECT_EQ(dut.Mark(kGrid, left).size(), static_cast<std::size_t>(needed));
      EXPECT_EQ(left, spare);
    }
    Fill(rays, dut);
    std::atomic<std::int64_t> none_left = -1;
    EXPECT_TRUE(dut.Mark(kGrid, none_left).empty());
    Fill(rays, dut);
    EXPECT_EQ(VoxelsOf(Mark(dut)), Walked(rays));
  }
}

TEST(RaySector, RaysThatGoNowhereAreNoRays) {
  RaySector dut;
  dut.Add({{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(dut.size(), 0u);
  EXPECT_TRUE(Mark(dut).empty());
}

}  // namespace
}  // namespace clearway
