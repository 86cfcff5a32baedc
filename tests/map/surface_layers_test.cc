#include "map/surface_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

// Two blocks along each axis, half full; so many of the voxels are ends.
class SurfaceLayersTest : public testing::TestWithParam<double> {};

TEST_P(SurfaceLayersTest, AreAcrossAxesWithoutAnOccupiedNeighbour) {
  testing_support::Random random(3);
  VoxelMap map(0.1);
  ScanUpdate update;
  std::vector<VoxelKey> ends;
  const auto for_each = [](int from, int to, const auto& visit) {
    for (int i = from; i < to; ++i) {
      for (int j = from; j < to; ++j) {
        for (int k = from; k < to; ++k) visit(VoxelKey{i, j, k});
      }
    }
  };
  for_each(-9, 9, [&](VoxelKey key) {
    if (random.Uniform(0, 1) < 0.3) map.Set(key, map.model().clamp_max);
  });
  for_each(-8, 8, [&](VoxelKey key) {
    if (random.Uniform(0, 1) >= GetParam()) return;
    update.MarkEnd(key);
    ends.push_back(key);
  });
  ThreadPool pool(2);
  const SurfaceLayers dut(map, update, pool);
  for (const VoxelKey key : ends) {
    const auto occupied = [&](int x, int y, int z) {
      return map.State({key.x + x, key.y + y, key.z + z}) == VoxelState::kOccupied;
    };
    unsigned expected = 0;
    if (!occupied(-1, 0, 0) && !occupied(1, 0, 0)) expected |= 1;
    if (!occupied(0, -1, 0) && !occupied(0, 1, 0)) expected |= 2;
    if (!occupied(0, 0, -1) && !occupied(0, 0, 1)) expected |= 4;
    const auto place = std::ranges::find(update.keys(), BlockOf(key)) - update.keys().begin();
    EXPECT_EQ(dut.AxesAcross(static_cast<std::size_t>(place), key), expected)
        << key.x << " " << key.y << " " << key.z;
  }
}

INSTANTIATE_TEST_SUITE_P(Ends, SurfaceLayersTest, testing::Values(1, 0.1, 0.003));

TEST(SurfaceLayers, OfAnEmptyMapAreAcrossAllAxes) {
  ScanUpdate update;
  update.MarkEnd(VoxelKey{3, 4, 5});
  ThreadPool pool(1);
  const SurfaceLayers dut(VoxelMap(0.1), update, pool);
  EXPECT_EQ(dut.AxesAcross(0, {3, 4, 5}), 7u);
}

}  // namespace
}  // namespace clearway
