// Planning problems as data, solved in scenes of given objects; plans are judged by the state
// checker at many times, and where objects go by hand.
#include "clearway/planning/solve_task.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clearway/collision/scene_checker.h"
#include "collision/test_world.h"
#include "planning/fixtures.h"
#include "planning/solved_tasks.h"

namespace clearway {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const auto kGoOn = [] { return false; };

Twist Going(double x_mps, double y_mps) { return {Eigen::Vector3d::Zero(), {x_mps, y_mps, 0}}; }

TEST(SolveTask, GoesStraightWhereNothingIs) {
  const ScenePtr scene = TestWorld().Scene();
  const PlanTask task = AcrossThePlace();
  const Solved solved = SolveFor(8.0005, scene, Disc(), task);
  ExpectGood(solved, scene, Disc(), task);
  EXPECT_NEAR(ToSeconds(solved.plans.back().times.back() - task.start_time), 8, 1e-3);
}

TEST(SolveTask, WaitsForADoorThatOpens) {
  TestWorld world;
  world.Given(1, Box{{0.2, 4.6, 2}}, Pose::Translation(0, -2.7, 0));
  world.Given(2, Box{{0.2, 4.6, 2}}, Pose::Translation(0, 2.7, 0));
  // The gap of 0.8 m is shut by a door until it has slid away, at 10 s.
  world.Given(
      3, Box{{0.1, 1.2, 2}}, Pose::Translation(0, 0, 0), {},
      {{TestTime(9), Pose::Translation(0, 0, 0)}, {TestTime(10), Pose::Translation(0, 2, 0)}});
  const ScenePtr scene = world.Scene();
  const PlanTask task = AcrossThePlace();
  const Solved solved = SolveFor(15, scene, Disc(), task);
  ExpectGood(solved, scene, Disc(), task);
  const double arrival_s = ToSeconds(solved.plans.back().times.back() - task.start_time);
  EXPECT_GT(arrival_s, 12);
  EXPECT_LE(arrival_s, 15);
}

TEST(SolveTask, TurnsALongRobotThroughAGap) {
  TestWorld world;
  world.Given(1, Box{{0.2, 4.5, 2}}, Pose::Translation(0, -2.75, 0));
  world.Given(2, Box{{0.2, 4.5, 2}}, Pose::Translation(0, 2.75, 0));
  const ScenePtr scene = world.Scene();
  const Robot robot = Robot::SingleShape("long", Box{{1.6, 0.4, 1}});
  PlanTask task = AcrossThePlace();
  task.space = PlaneSpace{};
  task.max_turn_radps = 1;
  task.start = {-3, 0, M_PI / 2};
  task.goal = {3, 0, M_PI / 2};
  const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
  ExpectGood(solved, scene, robot, task);
}

TEST(SolveTask, FliesOverAWall) {
  TestWorld world;
  world.Given(1, Box{{0.2, 20, 4}}, Pose::Translation(0, 0, 0));
  world.Given(2, Sphere{0.5}, Pose::Translation(0, -3, 2.6), Going(0, 0.5));
  const ScenePtr scene = world.Scene();
  const Robot robot = Robot::SingleShape("drone", Box{{0.4, 0.4, 0.2}});
  for (const bool turns : {false, true}) {
    PlanTask task = AcrossThePlace();
    task.space = FlightSpace{turns};
    task.area_W = {{-5, -5, 0}, {5, 5, 4}};
    task.max_turn_radps = 1;
    task.start = {-4, 0, 1};
    task.goal = {4, 0, 1};
    for (auto* ends : {&task.start, &task.goal}) {
      if (turns) ends->insert(ends->end(), {0, 0, 0, 1});
    }
    const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
    ExpectGood(solved, scene, robot, task);
  }
}

// OMPL refuses angles and quaternions that its own spaces do not hold, by ending the program.
TEST(SolveTask, TurnsAreTakenAsTheyAreGiven) {
  const ScenePtr scene = TestWorld().Scene();
  PlanTask task = AcrossThePlace();
  task.space = PlaneSpace{};
  task.max_turn_radps = 1;
  for (const double yaw_rad : {M_PI, -M_PI, 7.0, -100.0}) {
    task.start = {-4, 0, yaw_rad};
    task.goal = {4, 0, -yaw_rad};
    const Solved solved = SolveFor(kAnyTime_s, scene, Disc(), task);
    ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
    EXPECT_EQ(solved.outcome->status, PlanStatus::kFound) << yaw_rad;
  }
  task.space = FlightSpace{};
  task.area_W = {{-5, -5, -5}, {5, 5, 5}};
  task.start = {-4, 0, 0, 0, 0, 0, 1 - 1e-7};
  task.goal = {4, 0, 0, 0, 0, 0.7071067, -0.7071068};
  const Solved solved = SolveFor(kAnyTime_s, scene, Disc(), task);
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
}

TEST(SolveTask, AnArmReachesPastAPost) {
  PlanTask task = AcrossThePlace();
  const Robot robot = PlaneArm(3, 0.5, 0.08, task);
  task.start = {-1, 0, 0};
  task.goal = {1, 0, 0};
  TestWorld world;
  world.Given(1, Cylinder{0.1, 1}, Pose::Translation(1.2, 0, 0));
  const ScenePtr scene = world.Scene();
  const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
  ExpectGood(solved, scene, robot, task);
}

TEST(SolveTask, WhoIsThereAlreadyArrivesAtOnce) {
  PlanTask task = AcrossThePlace();
  for (const double away_m : {0.0, 1e-10, 1e-7}) {  // at 1 m/s a tenth of a microsecond is no way
    task.goal = {task.start[0] + away_m, task.start[1]};
    const Solved solved = SolveIn(TestWorld().Scene(), Disc(), task);
    ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
    EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
    ASSERT_EQ(solved.plans.size(), 1u);
    EXPECT_EQ(solved.plans[0].times, std::vector<Time>{task.start_time});
    EXPECT_EQ(solved.plans[0].configurations, std::vector<std::vector<double>>{task.start});
    EXPECT_TRUE(solved.plans[0].motion.times.empty());
  }
}

TEST(SolveTask, GoesAVeryShortWay) {
  const ScenePtr scene = TestWorld().Scene();
  PlanTask task = AcrossThePlace();
  for (const double away_m : {2e-6, 1e-3}) {
    task.goal = {task.start[0] + away_m, task.start[1]};
    ExpectGood(SolveIn(scene, Disc(), task), scene, Disc(), task);
  }
}

TEST(SolveTask, AJointMayBeLocked) {
  Robot robot{"arm", {}};
  for (const char* name : {"base", "one", "two"}) {
    robot.links.push_back({name, {{Box{{0.5, 0.1, 0.1}}, Pose{}}}});
  }
  PlanTask task = AcrossThePlace();
  task.space = ArmSpace{Pose{},
                        {{Pose::Translation(0.5, 0, 0), Eigen::Vector3d::UnitZ(), -1, 1, 1},
                         {Pose::Translation(0.5, 0, 0), Eigen::Vector3d::UnitZ(), 0.5, 0.5, 1}}};
  task.start = {-1, 0.5};
  task.goal = {1, 0.5};
  const Solved solved = SolveFor(kAnyTime_s, TestWorld().Scene(), robot, task);
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
}

// The checker's failure is told, not taken for a start in collision.
TEST(SolveTask, AFailingCheckerIsNoBlockedStart) {
  const auto checker = std::make_shared<FailingChecker>(absl::UnavailableError("gone"));
  PlanTask task = AcrossThePlace();
  task.start_time = std::max(task.start_time, checker->stamp());
  const auto outcome = Solve(
      task, checker, kBudget, [](const Plan&) {}, kGoOn);
  EXPECT_EQ(outcome.status(), absl::UnavailableError("gone"));
}

TEST(SolveTask, SaysWhatIsInTheWayOfStartOrGoal) {
  TestWorld world;
  world.Given(7, Cylinder{0.5, 1}, Pose::Translation(4, 0, 0));
  world.Given(8, Cylinder{0.5, 1}, Pose::Translation(-4, 2, 0), Going(0, 0.1));
  const ScenePtr scene = world.Scene();
  PlanTask task = AcrossThePlace();
  Solved solved = SolveIn(scene, Disc(), task, milliseconds(50));
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kGoalBlocked);
  EXPECT_EQ(solved.outcome->blocker.object, 7);
  std::swap(task.start, task.goal);
  solved = SolveIn(scene, Disc(), task);
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kStartBlocked);
  EXPECT_EQ(solved.outcome->blocker.object, 7);
  EXPECT_TRUE(solved.plans.empty());
}

// To sum up what part of a large robot is unknown all along a way takes seconds.
TEST(SolveTask, EndsWithinAQuestionThatTakesLong) {
  PlanTask task = AcrossThePlace();
  task.options.check.unknown = UnknownPolicy::kTolerated;
  task.options.check.max_unknown_fraction = 1;
  const Robot robot = Robot::SingleShape("hall", Box{{50, 50, 7}});
  const Solved solved = SolveIn(TestWorld().Scene(), robot, task, milliseconds(10));
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kNotFound);
}

TEST(SolveTask, EndsInTimeWhereThereIsNoWay) {
  TestWorld world;
  world.Given(1, Box{{0.2, 30, 2}}, Pose::Translation(0, 0, 0));
  const auto begin = std::chrono::steady_clock::now();
  const Solved solved = SolveIn(world.Scene(), Disc(), AcrossThePlace(), milliseconds(100));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(5));
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kNotFound);
  EXPECT_TRUE(solved.plans.empty());
}

TEST(SolveTask, EndsWhenItIsCancelled) {
  const auto checker = std::make_shared<SceneChecker>(TestWorld().Scene(), Disc());
  int plans = 0;
  const auto outcome = Solve(
      AcrossThePlace(), checker, seconds(1000), [&](const Plan&) { ++plans; }, [] { return true; });
  ASSERT_TRUE(outcome.ok()) << outcome.status();
  EXPECT_EQ(outcome->status, PlanStatus::kNotFound);
  EXPECT_EQ(plans, 0);
}

TEST(SolveTask, BadTasksAreRefusedByName) {
  const auto message = [](auto&& spoil) {
    PlanTask task = AcrossThePlace();
    spoil(task);
    const Solved solved = SolveIn(TestWorld().Scene(), Disc(), task);
    EXPECT_TRUE(solved.plans.empty());
    return std::string(solved.outcome.status().message());
  };
  const auto expect = [&](const char* field, auto&& spoil) {
    EXPECT_EQ(message(spoil).rfind(field, 0), 0u) << field << ": " << message(spoil);
  };
  expect("area.x", [](PlanTask& t) { t.area_W.min.x() = NAN; });
  expect("area.y", [](PlanTask& t) { t.area_W.max.y() = -6; });
  expect("max_speed_mps", [](PlanTask& t) { t.max_speed_mps = 0; });
  expect("max_speed_mps", [](PlanTask& t) { t.max_speed_mps = NAN; });
  expect("time_limit_s is 30;", [](PlanTask& t) { t.max_speed_mps = 1e-300; });
  expect("max_turn_radps", [](PlanTask& t) {
    t.space = PlaneSpace{};
    t.start.push_back(0);
    t.goal.push_back(0);
  });
  expect("start has", [](PlanTask& t) { t.start = {1}; });
  expect("start[0]", [](PlanTask& t) { t.start[0] = NAN; });
  expect("goal[1]", [](PlanTask& t) { t.goal[1] = 6; });
  expect("time_limit_s", [](PlanTask& t) { t.time_limit = Duration::zero(); });
  expect("time_limit_s", [](PlanTask& t) { t.time_limit = seconds(4000); });
  expect("time_limit_s is 5", [](PlanTask& t) { t.time_limit = seconds(5); });  // too far away
  expect("start_ns", [](PlanTask& t) { t.start_time = TimeFromNanoseconds(INT64_MIN); });
  expect("arm.joints", [](PlanTask& t) { t.space = ArmSpace{}; });
  expect("padding_m", [](PlanTask& t) { t.options.check.padding_m = -1; });
  expect("contact_resolution_m", [](PlanTask& t) { t.options.contact_resolution_m = 0; });
}

// What is told to be the least time is enough.
TEST(SolveTask, TheTimeThatItTakesIsEnough) {
  PlanTask task = AcrossThePlace();
  for (const double x : {1.0, 2.1, 3.7, 0.123456789}) {
    task.goal = {x, 3.3};
    task.time_limit = seconds(1);
    const std::string message(
        SolveIn(TestWorld().Scene(), Disc(), task).outcome.status().message());
    const std::size_t at = message.find("after ");
    ASSERT_NE(at, std::string::npos) << message;
    task.time_limit = FromSeconds(std::stod(message.substr(at + 6)));
    const Solved solved = SolveFor(kAnyTime_s, TestWorld().Scene(), Disc(), task);
    ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
    EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
    EXPECT_LE(solved.plans.back().times.back(), task.start_time + task.time_limit);
  }
}

TEST(SolveTask, AStartInTheScenesPastIsRefused) {
  TestWorld world;
  SceneSnapshot scene = *world.Scene();
  scene.stamp = TestTime(3);
  const Solved solved =
      SolveIn(std::make_shared<const SceneSnapshot>(scene), Disc(), AcrossThePlace());
  EXPECT_EQ(solved.outcome.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(solved.outcome.status().message().rfind("start_ns", 0), 0u);
}

}  // namespace
}  // namespace clearway
