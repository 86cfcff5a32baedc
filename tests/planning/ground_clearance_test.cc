// Ground robots over even ground, wherever in a voxel it lies.
#include <gtest/gtest.h>

#include "planning/solved_tasks.h"

namespace clearway {
namespace {

// Even ground: the voxels that hold its points.
ScenePtr GroundAt(double z_m, double resolution_m) {
  SceneParams params;
  params.resolution_m = resolution_m;
  SceneSnapshot scene = SceneSnapshot::Empty(params);
  scene.stamp = kTestStart;
  for (double x = -6; x < 6; x += 0.5 * resolution_m) {
    for (double y = -1.5; y < 1.5; y += 0.5 * resolution_m) {
      scene.static_map_W.Set(scene.static_map_W.grid().KeyOf({x, y, z_m}), 4000);
    }
  }
  return std::make_shared<const SceneSnapshot>(scene);
}

PlanTask AlongTheGround(double z_m) {
  PlanTask task = AcrossThePlace();
  task.space = PlaneSpace{.ground_z_m = z_m};
  task.area_W = {{-5, -1, 0}, {5, 1, 0}};
  task.max_turn_radps = 1;
  task.start = {-3, 0, 0};
  task.goal = {3, 0, 3};
  return task;
}

std::vector<Robot> Robots() {
  return {
      Robot::SingleShape("box", Box{{1, 0.7, 1}}), Robot::SingleShape("cylinder", Cylinder{0.3, 1}),
      Robot::SingleShape("sphere", Sphere{0.3}), Robot::SingleShape("capsule", Capsule{0.2, 0.6}),
      Robot::SingleShape("mesh", TriangleMesh{CubeMesh(0.4)})};
}

TEST(GroundClearance, TheDefaultIsEnoughWhereverTheGroundLiesInAVoxel) {
  for (const double resolution_m : {0.05, 0.1, 0.2}) {
    for (const double share : {0.0, 1e-9, 0.1, 0.5, 0.7, 0.9, 0.99, 1 - 1e-9}) {
      for (const double layer : {-3.0, 0.0, 7.0}) {
        const double z_m = (layer + share) * resolution_m;
        const ScenePtr scene = GroundAt(z_m, resolution_m);
        for (const Robot& robot : Robots()) {
          const Solved solved = SolveFor(kAnyTime_s, scene, robot, AlongTheGround(z_m));
          ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
          EXPECT_EQ(solved.outcome->status, PlanStatus::kFound)
              << robot.name << " on " << z_m << " in voxels of " << resolution_m;
        }
      }
    }
  }
}

TEST(GroundClearance, BelowTheGroundIsRefused) {
  PlanTask task = AlongTheGround(0);
  std::get<PlaneSpace>(task.space).clearance_m = -0.1;
  const absl::Status dut = Validate(task, Robots()[0]);
  EXPECT_TRUE(absl::IsInvalidArgument(dut));
  EXPECT_NE(dut.message().find("plane.clearance_m"), absl::string_view::npos) << dut;
  std::get<PlaneSpace>(task.space).clearance_m = 0;
  EXPECT_TRUE(Validate(task, Robots()[0]).ok());
}

// Any clearance that keeps off the voxels' top is enough, be it by a hair; what touches is blocked.
TEST(GroundClearance, WhatIsAboveTheGroundsVoxelsIsFree) {
  const ScenePtr scene = GroundAt(0, 0.1);
  for (const Robot& robot : Robots()) {
    for (const double clearance_m : {0.1001, 0.101, 0.102, 0.105, 0.11}) {
      PlanTask task = AlongTheGround(0);
      std::get<PlaneSpace>(task.space).clearance_m = clearance_m;
      const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
      ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
      ASSERT_EQ(solved.outcome->status, PlanStatus::kFound) << robot.name << " " << clearance_m;
      EXPECT_LT(ToSeconds(solved.plans.front().times.back() - task.start_time), 6.001);
    }
    PlanTask task = AlongTheGround(0);
    std::get<PlaneSpace>(task.space).clearance_m = 0.1;
    const Solved touching = SolveIn(scene, robot, task);
    EXPECT_EQ(touching.outcome->status, PlanStatus::kStartBlocked) << robot.name;
  }
}

// Padding grows the robot downwards, too.
TEST(GroundClearance, TheDefaultAllowsForPadding) {
  PlanTask task = AlongTheGround(0.03);
  task.options.check.padding_m = 0.2;
  const Solved solved = SolveFor(kAnyTime_s, GroundAt(0.03, 0.1), Robots()[0], task);
  EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
}

// What stands higher than it above the ground is seen.
TEST(GroundClearance, AnObstacleOfThatHeightIsSeen) {
  for (const double z_m : {0.0, 0.05, 0.0999}) {
    SceneSnapshot scene = *GroundAt(z_m, 0.1);
    for (double y = -1.4; y < 1.45; y += 0.05) {
      for (double up_m = 0; up_m <= 0.151; up_m += 0.05) {
        scene.static_map_W.Set(scene.static_map_W.grid().KeyOf({0, y, z_m + up_m}), 4000);
      }
    }
    PlanTask task = AlongTheGround(z_m);
    task.area_W.min.y() = -0.5;
    task.area_W.max.y() = 0.5;
    const Solved solved = SolveIn(std::make_shared<const SceneSnapshot>(scene), Robots()[0], task);
    EXPECT_NE(solved.outcome->status, PlanStatus::kFound) << z_m;
  }
}

}  // namespace
}  // namespace clearway
