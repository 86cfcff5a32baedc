#include "clearway/report/static_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/test_scene.h"

namespace clearway {
namespace {

// The floor and the wall of the test scene, and something that moves, which is none of it.
World FloorAndWall() {
  World world;
  world.Add(
      Body::Single(0, "floor", Box{{20, 20, 0.1}}, FixedPose{Pose::Translation(0, 0, -0.95)}));
  world.Add(Body::Single(0, "wall", Box{{0.2, 20, 2}}, FixedPose{Pose::Translation(2.1, 0, 0)}));
  world.Add(Body::Single(7, "car", Box{{2, 1, 1}}, FixedPose{Pose::Translation(-2, 0, 0)}));
  return world;
}

// Rays that end in the middle of some voxels of the wall and of the floor.
MetSurfaces SomeMet() {
  Frame frame;
  frame.stamp = TestScene().stamp;
  for (int i = 0; i < 40; ++i) {
    const float along = -1.95f + 0.1f * static_cast<float>(i);
    frame.points_S.push_back({2.05f, along, 0.05f});
    frame.points_S.push_back({along, 0.05f, -0.95f});
  }
  frame.labels.assign(frame.points_S.size(), kStaticLabel);
  MetSurfaces met(std::make_shared<const World>(FloorAndWall()));
  met.Add(frame, Pose{}, TestScene());
  return met;
}

StaticFit Fit(const VoxelMap& map, const World& world = FloorAndWall()) {
  return FitOf(map, world, SomeMet());
}

TEST(StaticFit, OfTheRightMapIsPerfect) {
  const StaticFit dut = Fit(TestScene().static_map_W);
  EXPECT_EQ(dut.occupied, 100 * 100 + 2 * 100 * 19);
  EXPECT_EQ(dut.Residual(), 0);
  EXPECT_EQ(dut.OccupiedPrecision(), 1);
  EXPECT_EQ(dut.OccupiedRecall(), 1);
  EXPECT_EQ(dut.FreePrecision(), 1);
  EXPECT_EQ(dut.FreeRecall(), 1);
}

TEST(StaticFit, TheGridTellsWhatTheMapSaysRightThere) {
  VoxelMap map(0.1);
  const auto Said = [&](Confusion::Said said) {
    return Fit(map).grid.truly_free[static_cast<std::size_t>(said)];
  };
  map.Set({4, 0, 0}, -1000);  // of the eight of its block that count
  EXPECT_EQ(Said(Confusion::kFree), 1);
  EXPECT_EQ(Said(Confusion::kOccupied), 0);
  EXPECT_EQ(Said(Confusion::kUnknown), 7);
  map.Set({0, 4, 4}, 1000);
  map.Set({1, 4, 4}, 1000);  // not of the grid
  EXPECT_EQ(Said(Confusion::kOccupied), 1);
  EXPECT_EQ(Said(Confusion::kUnknown), 6);
}

TEST(StaticFit, TheGridCountsSurfacesThatWereMet) {
  const StaticFit right = Fit(TestScene().static_map_W);
  EXPECT_EQ(right.grid.truly_occupied, (Confusion::Counts{0, right.met, 0}));
  EXPECT_EQ(right.grid.truly_free[Confusion::kOccupied], 0);
  const StaticFit nothing = Fit(VoxelMap(0.1));
  EXPECT_EQ(nothing.grid.truly_occupied, (Confusion::Counts{0, 0, right.met}));
}

TEST(StaticFit, OneVoxelOffIsRightTwoAreNot) {
  for (const int off : {1, 2}) {
    VoxelMap map = TestScene().static_map_W;
    map.Set({20 - off, 0, 0}, 4000);
    const StaticFit dut = Fit(map);
    EXPECT_EQ(dut.Residual(), off - 1) << off;
    EXPECT_EQ(dut.truly_free - dut.free_found, 0) << "what is beside it is free";
  }
}

// A trail of what moved, wider than what is beside each voxel.
TEST(StaticFit, TrailsAreResidual) {
  SceneSnapshot scene = TestScene();
  FillBox(scene.static_map_W, {{-3, -0.5, -0.5}, {-1, 0.5, 0.5}}, 4000);
  const StaticFit dut = Fit(scene.static_map_W);
  EXPECT_EQ(dut.Residual(), 20 * 10 * 10);
  EXPECT_EQ(dut.truly_free - dut.free_found, 18 * 8 * 8);
  EXPECT_LT(dut.OccupiedPrecision(), 0.9);
  EXPECT_EQ(dut.OccupiedRecall(), 1);
}

// The map says free where a block is that no ray has met.
TEST(StaticFit, FreeSpaceInABlockIsWrong) {
  World world = FloorAndWall();
  world.Add(Body::Single(0, "block", Box{{1, 1, 1}}, FixedPose{Pose::Translation(-3.5, 3.5, 0)}));
  const StaticFit dut = Fit(TestScene().static_map_W, world);
  EXPECT_EQ(dut.free - dut.free_right, 8 * 8 * 8);  // the others lie a voxel inside at most
  EXPECT_EQ(dut.Residual(), 0);
}

// Where rays met the wall, layers of voxels are missing.
TEST(StaticFit, WhatWasMetAndIsMissingIsFound) {
  VoxelMap map = TestScene().static_map_W;
  FillBox(map, {{1.9, -5, -0.3}, {2.3, 5, 0.3}}, -1000);
  const StaticFit dut = Fit(map);
  EXPECT_EQ(dut.met, 80);
  EXPECT_EQ(dut.met_found, 40);
  EXPECT_EQ(dut.OccupiedRecall(), 0.5);
}

TEST(StaticFit, OfNothingIsNoNumber) {
  const StaticFit dut =
      FitOf(VoxelMap(0.1), FloorAndWall(), MetSurfaces(std::make_shared<const World>()));
  EXPECT_TRUE(std::isnan(dut.OccupiedPrecision()));
  EXPECT_TRUE(std::isnan(dut.FreeRecall()));
}

}  // namespace
}  // namespace clearway
