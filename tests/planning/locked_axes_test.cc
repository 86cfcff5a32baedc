// Joints that are locked, and areas without an extent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning/solved_tasks.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

// An arm of links side by side in an empty world.
PlanTask ArmTask(int joints, Robot& robot) {
  PlanTask task = AcrossThePlace();
  robot = PlaneArm(joints, 0.5, 0.1, task);
  task.start.assign(joints, -1);
  task.goal.assign(joints, 1);
  return task;
}

void Lock(PlanTask& task, std::size_t joint, double rad) {
  Joint& locked = std::get<ArmSpace>(task.space).joints[joint];
  locked.min_rad = locked.max_rad = rad;
  locked.max_radps = 0;
  task.start[joint] = task.goal[joint] = rad;
}

TEST(LockedJoints, StayWhileTheOthersMove) {
  for (std::size_t locked = 0; locked < 3; ++locked) {
    Robot robot;
    PlanTask task = ArmTask(3, robot);
    Lock(task, locked, 0.4);
    // In the way of the straight motion, so that places are drawn.
    TestWorld world;
    world.Given(1, Box{{0.1, 0.1, 2}}, Pose::Translation(1.2, 0, 0));
    const ScenePtr scene = world.Scene();
    const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
    ExpectGood(solved, scene, robot, task);
    for (const Plan& plan : solved.plans) {
      for (const auto& configuration : plan.configurations) {
        EXPECT_EQ(configuration[locked], 0.4);
      }
    }
  }
}

TEST(LockedJoints, AnArmOfThemIsAtItsGoal) {
  for (const int joints : {1, 2}) {
    Robot robot;
    PlanTask task = ArmTask(joints, robot);
    for (int j = 0; j < joints; ++j) Lock(task, j, 0);
    const Solved solved = SolveIn(TestWorld().Scene(), robot, task);
    ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
    EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
    ASSERT_EQ(solved.plans.size(), 1u);
    EXPECT_THAT(solved.plans[0].configurations, testing::ElementsAre(task.start));
  }
}

TEST(LockedJoints, LimitsThatDescendAreRefused) {
  Robot robot;
  PlanTask task = ArmTask(2, robot);
  std::get<ArmSpace>(task.space).joints[1].max_rad = -3;
  const auto status = SolveIn(TestWorld().Scene(), robot, task).outcome.status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(status.message(),
            "arm.joints[1]: min_rad is -2.5; it must be at most max_rad, which is -3");
  task = ArmTask(2, robot);
  std::get<ArmSpace>(task.space).joints[1].max_radps = 0;  // not locked
  EXPECT_THAT(std::string(SolveIn(TestWorld().Scene(), robot, task).outcome.status().message()),
              HasSubstr("arm.joints[1].max_radps is 0"));
}

// On a rail, and turning on the spot; on the ground and in flight.
TEST(AreasWithoutExtent, HoldTheRobotThere) {
  PlanTask rail = AcrossThePlace();
  rail.area_W.min.y() = rail.area_W.max.y() = 0;
  PlanTask turns = AcrossThePlace();
  turns.space = PlaneSpace{};
  turns.max_turn_radps = 1;
  turns.area_W = {{1, 2, 0}, {1, 2, 0}};
  turns.start = {1, 2, -1};
  turns.goal = {1, 2, 1};
  PlanTask lift = AcrossThePlace();
  lift.space = FlightSpace{.turns = false};
  lift.area_W = {{1, 2, 0}, {1, 2, 3}};
  lift.start = {1, 2, 0.5};
  lift.goal = {1, 2, 2.5};
  PlanTask gimbal = AcrossThePlace();
  gimbal.space = FlightSpace{};
  gimbal.max_turn_radps = 1;
  gimbal.area_W = {{1, 2, 3}, {1, 2, 3}};
  gimbal.start = {1, 2, 3, 0, 0, 0, 1};
  gimbal.goal = {1, 2, 3, 0, 0, std::sin(0.5), std::cos(0.5)};
  const Robot robot = Robot::SingleShape("box", Box{{0.6, 0.3, 0.2}});
  for (const PlanTask& task : {rail, turns, lift, gimbal}) {
    // In the way at first, so that the robot has to wait or to go about it.
    TestWorld world;
    world.Given(1, Sphere{0.2}, Pose::Translation(task.start[0] + 0.6, task.start[1], 0.5), {},
                {{TestTime(0.5), Pose::Translation(50, 50, 50)},
                 {TestTime(100), Pose::Translation(50, 50, 50)}});
    const ScenePtr scene = world.Scene();
    const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
    ExpectGood(solved, scene, robot, task);
    for (const Plan& plan : solved.plans) {
      for (const auto& configuration : plan.configurations) {
        for (int axis = 0; axis < 2; ++axis) {
          EXPECT_GE(configuration[axis], task.area_W.min[axis]);
          EXPECT_LE(configuration[axis], task.area_W.max[axis]);
        }
      }
    }
  }
}

TEST(AreasWithoutExtent, AStartThatIsTheGoalIsThere) {
  PlanTask task = AcrossThePlace();
  task.area_W = {{1, 2, 0}, {1, 2, 0}};
  task.start = task.goal = {1, 2};
  const Solved solved = SolveIn(TestWorld().Scene(), Disc(), task);
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
}

}  // namespace
}  // namespace clearway
