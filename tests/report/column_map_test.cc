#include "report/column_map.h"

#include <gtest/gtest.h>

#include "report/test_scene.h"

namespace clearway::report {
namespace {

constexpr double kMaxHeightM = 3;

const Column& ColumnAt(const ColumnMap& map, double x_m, double y_m) {
  const VoxelGrid grid(map.resolution_m);
  const VoxelKey key = grid.KeyOf({x_m, y_m, 0});
  return map.At(key.x - map.x0, key.y - map.y0);
}

TEST(ColumnMap, Empty) {
  const ColumnMap dut = ColumnsOf(VoxelMap(0.1), {{0, 0, 0}, {0.95, 0.45, 0}}, kMaxHeightM);
  EXPECT_EQ(dut.width, 10);
  EXPECT_EQ(dut.height, 5);
  for (const Column& column : dut.columns) EXPECT_EQ(column.state, VoxelState::kUnknown);
}

TEST(ColumnMap, TellsGroundWallAndUnknownApart) {
  const SceneSnapshot scene = TestScene();
  const ColumnMap dut = ColumnsOf(scene.static_map_W, {{-6, -6, 0}, {6, 6, 0}}, kMaxHeightM);
  EXPECT_EQ(ColumnAt(dut, 0.05, 0.05).state, VoxelState::kOccupied);
  EXPECT_NEAR(ColumnAt(dut, 0.05, 0.05).height_m, 0, 0.05);
  EXPECT_EQ(ColumnAt(dut, 2.05, 0.05).state, VoxelState::kOccupied);
  EXPECT_NEAR(ColumnAt(dut, 2.05, 0.05).height_m, 1.9, 0.05);
  EXPECT_EQ(ColumnAt(dut, 5.55, 0.05).state, VoxelState::kUnknown);
}

TEST(ColumnMap, FreeWhereOnlyFreeVoxelsAre) {
  VoxelMap map(0.1);
  FillBox(map, {{0, 0, 0}, {1, 1, 1}}, map.model().clamp_min);
  const ColumnMap dut = ColumnsOf(map, {{-1, -1, 0}, {2, 2, 0}}, kMaxHeightM);
  EXPECT_EQ(ColumnAt(dut, 0.55, 0.55).state, VoxelState::kFree);
  EXPECT_EQ(ColumnAt(dut, -0.55, 0.55).state, VoxelState::kUnknown);
}

TEST(ColumnMap, LeavesOutWhatIsTooHigh) {
  SceneSnapshot scene = TestScene();
  VoxelMap& map = scene.static_map_W;
  FillBox(map, {{-1, -1, 3}, {1, 1, 3.5}}, map.model().clamp_max);
  const ColumnMap dut = ColumnsOf(map, {{-5, -5, 0}, {4.9, 4.9, 0}}, kMaxHeightM);
  EXPECT_NEAR(ColumnAt(dut, 0.05, 0.05).height_m, 0, 0.05);
}

TEST(ColumnMap, StrayVoxelsBelowTheGroundDoNotLowerIt) {
  SceneSnapshot scene = TestScene();
  VoxelMap& map = scene.static_map_W;
  map.Set(map.grid().KeyOf({0.05, 0.05, -4}), map.model().clamp_max);
  const ColumnMap dut = ColumnsOf(map, {{-5, -5, 0}, {4.9, 4.9, 0}}, kMaxHeightM);
  EXPECT_NEAR(ColumnAt(dut, 0.25, 0.25).height_m, 0, 0.05);
}

TEST(ColumnMap, FollowsASlope) {
  VoxelMap map(0.1);
  for (int x = -100; x < 100; ++x) {
    for (int y = -20; y < 20; ++y) map.Set({x, y, x / 10}, map.model().clamp_max);  // 10 %
  }
  const ColumnMap dut = ColumnsOf(map, {{-10, -2, 0}, {9.9, 1.9, 0}}, kMaxHeightM);
  for (const Column& column : dut.columns) EXPECT_LT(std::abs(column.height_m), 0.35);
}

}  // namespace
}  // namespace clearway::report
