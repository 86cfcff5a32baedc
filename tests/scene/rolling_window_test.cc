// SceneParams::keep_distance_m.
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::FrameAt;

// A sensor that drives along x past walls; with a rolling window the map stays as large as it was.
TEST(RollingWindow, ForgetsWhatIsFarFromTheSensor) {
  ThreadPool pool(1);
  SceneParams params;
  params.keep_distance_m = 10;
  SceneBuilder dut(params, {}, pool), forgets_nothing({}, {}, pool);
  std::size_t most_blocks = 0;
  for (int k = 0; k < 100; ++k) {
    Frame frame = FrameAt(k);
    frame.T_W_S.translation = Eigen::Vector3d(k, 0, 0);
    for (int i = -20; i <= 20; ++i) AddPoint(frame, 0, {0.1 * i, 3, 0.5});
    ASSERT_TRUE(dut.Apply(frame).ok());
    ASSERT_TRUE(forgets_nothing.Apply(frame).ok());
    const std::size_t blocks = dut.Publish()->static_map_W.blocks().size();
    if (k == 20) most_blocks = blocks + 5;
    if (k > 20) {
      EXPECT_LE(blocks, most_blocks);
    }
  }
  const ScenePtr all = forgets_nothing.Publish(), kept = dut.Publish();
  EXPECT_GT(all->static_map_W.blocks().size(), 3 * most_blocks);
  VoxelMap expected = all->static_map_W;
  expected.ForgetBlocksOutside({{89, -10, -10}, {109, 10, 10}});
  EXPECT_TRUE(kept->static_map_W == expected);
  const VoxelGrid& grid = expected.grid();
  EXPECT_EQ(kept->static_map_W.State(grid.KeyOf({5, 3, 0.5})), VoxelState::kUnknown);
  EXPECT_EQ(kept->static_map_W.State(grid.KeyOf({95, 3, 0.5})), VoxelState::kOccupied);
}

TEST(RollingWindow, ForgetsAPriorToo) {
  ThreadPool pool(1);
  SceneParams params;
  params.keep_distance_m = 5;
  SceneBuilder dut(params, {}, pool);
  VoxelMap prior_W(params.resolution_m);
  prior_W.Set({0, 0, 0}, 100);
  prior_W.Set({200, 0, 0}, 100);
  ASSERT_TRUE(dut.LoadPrior(prior_W).ok());
  EXPECT_EQ(dut.Publish()->static_map_W.occupied_count(), 2);
  ASSERT_TRUE(dut.Apply(FrameAt(1)).ok());
  EXPECT_EQ(dut.Publish()->static_map_W.occupied_count(), 1);
}

}  // namespace
}  // namespace clearway
