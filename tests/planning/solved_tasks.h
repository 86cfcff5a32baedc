// Planning problems for tests, solved, and what is to be expected of solutions.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "clearway/planning/solve_task.h"
#include "collision/test_world.h"

namespace clearway {

inline constexpr auto kBudget = std::chrono::milliseconds(300);
inline constexpr double kAnyTime_s = 1e9;  // of SolveFor

// A disc of 0.3 m in a place of 10 m, from left to right.
inline PlanTask AcrossThePlace() {
  PlanTask task;
  task.space = PlaneSpace{.turns = false};
  task.area_W = {{-5, -5, 0}, {5, 5, 0}};
  task.max_speed_mps = 1;
  task.start = {-4, 0};
  task.goal = {4, 0};
  task.start_time = TestTime(0);
  task.time_limit = std::chrono::seconds(30);
  task.options.check.unknown = UnknownPolicy::kFree;
  return task;
}

inline Robot Disc() { return Robot::SingleShape("disc", Cylinder{0.3, 1}); }

// Links one after the other that turn about upright axes, 0.2 m above the ground, and the task's
// space for them.
inline Robot PlaneArm(int joints, double link_m, double thick_m, PlanTask& task) {
  const Box link{{link_m, thick_m, thick_m}};
  Robot robot{"arm", {{"base", {{link, {}}}}}};
  ArmSpace arm;
  for (int i = 1; i <= joints; ++i) {
    robot.links.push_back(
        {"link" + std::to_string(i), {{link, Pose::Translation(link_m / 2, 0, 0)}}});
    arm.joints.push_back({Pose::Translation(i == 1 ? 0 : link_m, 0, i == 1 ? 0.2 : 0),
                          Eigen::Vector3d::UnitZ(), -2.5, 2.5, 1});
  }
  task.space = arm;
  return robot;
}

struct Solved {
  absl::StatusOr<PlanOutcome> outcome;
  std::vector<Plan> plans;
};

inline Solved SolveIn(const ScenePtr& scene, const Robot& robot, const PlanTask& task,
                      Duration budget = kBudget) {
  const auto checker = std::make_shared<SceneChecker>(scene, robot);
  std::vector<Plan> plans;
  auto outcome = Solve(
      task, checker, budget, [&](const Plan& p) { plans.push_back(p); }, [] { return false; });
  return {std::move(outcome), std::move(plans)};
}

// The same until there is a plan that arrives that soon, however slow the machine is.
inline Solved SolveFor(double arrival_s, const ScenePtr& scene, const Robot& robot,
                       const PlanTask& task) {
  const auto checker = std::make_shared<SceneChecker>(scene, robot);
  std::vector<Plan> plans;
  const auto enough = [&] {
    return !plans.empty() && ToSeconds(plans.back().times.back() - task.start_time) <= arrival_s;
  };
  auto outcome = Solve(
      task, checker, std::chrono::seconds(60), [&](const Plan& p) { plans.push_back(p); }, enough);
  return {std::move(outcome), std::move(plans)};
}

// Of robots whose configurations begin with a position in metres.
inline void ExpectSpeedIsKept(const Plan& plan, const PlanTask& task) {
  const int axes = std::holds_alternative<PlaneSpace>(task.space) ? 2 : 3;
  for (std::size_t i = 1; i < plan.times.size(); ++i) {
    double squared_m2 = 0;
    for (int axis = 0; axis < axes; ++axis) {
      const double step_m = plan.configurations[i][axis] - plan.configurations[i - 1][axis];
      squared_m2 += step_m * step_m;
    }
    const double lasts_s = ToSeconds(plan.times[i] - plan.times[i - 1]);
    EXPECT_LE(std::sqrt(squared_m2), task.max_speed_mps * lasts_s + 1e-5);
  }
}

// The plan's motion is proved by a new checker, its ends are the task's, it keeps the speed limit,
// and later plans arrive earlier.
inline void ExpectGood(const Solved& solved, const ScenePtr& scene, const Robot& robot,
                       const PlanTask& task) {
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  ASSERT_EQ(solved.outcome->status, PlanStatus::kFound);
  ASSERT_FALSE(solved.plans.empty());
  EXPECT_EQ(solved.outcome->version, scene->version);
  EXPECT_EQ(solved.outcome->horizon, scene->params.horizon);
  EXPECT_EQ(solved.outcome->inflation_mps, task.options.check.inflation_mps);
  const SceneChecker checker(scene, robot);
  for (std::size_t p = 0; p < solved.plans.size(); ++p) {
    const Plan& plan = solved.plans[p];
    ASSERT_EQ(plan.times.size(), plan.configurations.size());
    EXPECT_EQ(plan.times.front(), task.start_time);
    EXPECT_EQ(plan.configurations.front(), task.start);
    for (std::size_t i = 0; i < task.goal.size(); ++i) {
      EXPECT_NEAR(plan.configurations.back()[i], task.goal[i], 1e-5);
    }
    EXPECT_LE(plan.times.back(), task.start_time + task.time_limit);
    EXPECT_EQ(plan.motion.times.front(), plan.times.front());
    EXPECT_EQ(plan.motion.times.back(), plan.times.back());
    const auto proof = checker.CheckMotions(plan.motion, task.options);
    ASSERT_TRUE(proof.ok()) << proof.status();
    EXPECT_EQ(proof->answers[0].status, SpaceStatus::kFree);
    if (!std::holds_alternative<ArmSpace>(task.space)) ExpectSpeedIsKept(plan, task);
    if (p == 0) continue;
    EXPECT_LT(plan.times.back(), solved.plans[p - 1].times.back());
  }
}

}  // namespace clearway
