// Places and ways that are free for a while only, and short ways in large places: plans are
// expected to arrive when by hand they can.
#include <gtest/gtest.h>

#include <atomic>

#include "clearway/planning/task_setup.h"
#include "planning/fixtures.h"
#include "planning/solved_tasks.h"

namespace clearway {
namespace {

using std::chrono::seconds;

void ExpectArrivesBy(double arrival_s, const ScenePtr& scene, const PlanTask& task) {
  const Solved solved = SolveFor(arrival_s, scene, Disc(), task);
  ExpectGood(solved, scene, Disc(), task);
  ASSERT_FALSE(solved.plans.empty());
  EXPECT_LE(ToSeconds(solved.plans.back().times.back() - task.start_time), arrival_s);
}

// From one time to another.
struct Window {
  double from_s, until_s;
};

// A shape that is where the pose says, but out of the way during the window.
void GivenBut(Window window, TestWorld& world, ObjectId id, const Shape& shape, const Pose& there) {
  const Pose away = Pose::Translation(0, 0, 10) * there;
  world.Given(id, shape, there, {},
              {{TestTime(window.from_s), there},
               {TestTime(window.from_s + 0.1), away},
               {TestTime(window.until_s), away},
               {TestTime(window.until_s + 0.1), there},
               {TestTime(10'000), there}});
}

// Until it is away the disc is kept 0.55 m before the goal.
TEST(SolveWindows, TheGoalIsFreeOnce) {
  for (const Window window : {Window{15, 19}, {20, 28}, {20, 28.5}, {30, 47}, {40, 46}}) {
    TestWorld world;
    GivenBut(window, world, 1, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 0, 0));
    PlanTask task = AcrossThePlace();
    // The time limit after the window and in it: then it is free to the end.
    for (const double limit_s : {60.0, window.until_s - 0.5}) {
      task.time_limit = FromSeconds(limit_s);
      ExpectArrivesBy(window.from_s + 0.7, world.Scene(), task);
    }
  }
}

// At the limit or hardly before; it cannot be reached in time.
TEST(SolveWindows, AGoalThatIsFreeAtTheLimitIsNotTaken) {
  for (const int limit_ms : {10'026, 10'030, 10'036, 10'040, 10'100}) {
    TestWorld world;
    GivenBut({10, 900}, world, 1, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 0, 0));
    PlanTask task = AcrossThePlace();
    task.time_limit = std::chrono::milliseconds(limit_ms);
    const Solved solved = SolveIn(world.Scene(), Disc(), task, std::chrono::milliseconds(50));
    ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
    EXPECT_EQ(solved.outcome->status, PlanStatus::kNotFound) << limit_ms;
  }
}

// The limit is tight, so that later paths are looked for too.
TEST(SolveWindows, AGoalThatIsFreeAfterTheLimitAloneIsTaken) {
  TestWorld world;
  GivenBut({15, 19}, world, 1, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 0, 0));
  PlanTask task = AcrossThePlace();
  task.time_limit = seconds(12);
  const Solved solved = SolveIn(world.Scene(), Disc(), task);
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kGoalBlocked);
  EXPECT_EQ(solved.outcome->blocker.object, 1);
  EXPECT_TRUE(solved.plans.empty());
}

// Too short a moment to get there, and none: that is told at once.
TEST(SolveWindows, AGoalThatIsFreeForAMomentIsNotTaken) {
  for (const double from_s : {20.0, 51.3, 90.17}) {
    TestWorld world;
    GivenBut({from_s, from_s + 0.1}, world, 1, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 0, 0));
    PlanTask task = AcrossThePlace();
    task.time_limit = seconds(100);
    for (const bool taken : {false, true}) {
      if (taken) world.Given(2, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 0, 0));
      const Solved solved = SolveIn(world.Scene(), Disc(), task);
      ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
      EXPECT_EQ(solved.outcome->status, taken ? PlanStatus::kGoalBlocked : PlanStatus::kNotFound);
    }
  }
}

// For a tenth of a second more than it takes to get there from where it is waited for.
TEST(SolveWindows, TheGoalIsFreeForShortLate) {
  for (const double from_s : {50.0, 71.3, 90.17}) {
    TestWorld world;
    GivenBut({from_s, from_s + 0.65}, world, 1, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 0, 0));
    PlanTask task = AcrossThePlace();
    task.time_limit = seconds(100);
    ExpectArrivesBy(from_s + 0.7, world.Scene(), task);
  }
}

// What was looked at in one call of solve is not looked at again in the next one.
TEST(SolveWindows, SolvedInSlicesItGoesOnWhereItStopped) {
  TestWorld world;
  GivenBut({1700, 1720}, world, 1, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 0, 0));
  PlanTask task = AcrossThePlace();
  task.time_limit = std::chrono::hours(1);
  const auto setup = MakeTaskSetup(task, std::make_shared<SceneChecker>(world.Scene(), Disc()));
  ASSERT_TRUE(setup.ok()) << setup.status();
  (*setup)->setup();
  int asked = 0;
  ompl::base::PlannerStatus end;
  for (int slice = 0; slice < 2000 && !end; ++slice) {
    asked = 0;
    end = (*setup)->getPlanner()->solve({[&] { return ++asked > 30; }});
  }
  EXPECT_EQ(end, ompl::base::PlannerStatus::EXACT_SOLUTION);
}

// Answers, but not from the second time on that it is asked for some times.
class FalteringChecker : public FailingChecker {
 public:
  FalteringChecker(ScenePtr scene, const Robot& robot, int fails)
      : FailingChecker(absl::UnavailableError("away")), checker_(scene, robot), fails_(fails) {}
  absl::StatusOr<CheckReply> Check(const StateBatch& batch,
                                   const CheckOptions& options) const override {
    const int call = calls_++;
    return call >= 1 && call <= fails_ ? FailingChecker::Check(batch, options)
                                       : checker_.Check(batch, options);
  }
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& batch,
                                           const MotionOptions& options) const override {
    return checker_.CheckMotions(batch, options);
  }
  const Robot& robot() const override { return checker_.robot(); }
  std::uint64_t version() const override { return checker_.version(); }
  Time stamp() const override { return checker_.stamp(); }

 private:
  SceneChecker checker_;
  int fails_;
  mutable std::atomic<int> calls_ = 0;
};

TEST(SolveWindows, NoAnswerIsNoTakenGoal) {
  TestWorld world;
  world.Given(1, Box{{0.5, 0.5, 2}}, Pose::Translation(4, 3, 0));
  for (const int fails : {1, 2, 5, 20}) {
    const auto setup = MakeTaskSetup(
        AcrossThePlace(), std::make_shared<FalteringChecker>(world.Scene(), Disc(), fails));
    ASSERT_TRUE(setup.ok()) << setup.status();
    (*setup)->setup();
    EXPECT_EQ((*setup)->getPlanner()->solve(60.0), ompl::base::PlannerStatus::EXACT_SOLUTION);
  }
}

TEST(SolveWindows, ATightLimitMayBeAtTheEndOfTime) {
  TestWorld world;
  PlanTask task = AcrossThePlace();
  task.time_limit = seconds(9);
  task.start_time = TimeFromNanoseconds(kFarthest_ns) - task.time_limit;
  const Solved solved = SolveIn(world.Scene(), Disc(), task);
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kFound);
}

TEST(SolveWindows, ADoorOpensOnce) {
  for (const Window window : {Window{12, 14}, {20, 23}, {30, 34}, {45, 49}}) {
    TestWorld world;
    world.Given(1, Box{{0.2, 4.6, 2}}, Pose::Translation(0, -2.7, 0));
    world.Given(2, Box{{0.2, 4.6, 2}}, Pose::Translation(0, 2.7, 0));
    GivenBut(window, world, 3, Box{{0.1, 1.2, 2}}, {});
    PlanTask task = AcrossThePlace();
    task.time_limit = seconds(60);
    ExpectArrivesBy(window.until_s + 4, world.Scene(), task);
  }
}

// The only door is free for half a second at a time, late, too: between looks that are the farther
// apart the longer it has been closed. A robot at 4 m/s needs 0.18 s of that.
TEST(SolveWindows, AShortGapThatOpensLateIsFound) {
  for (const double opens_s : {3.07, 5.6, 9.13, 17.21}) {
    TestWorld world;
    world.Given(1, Box{{0.1, 4.6, 2}}, Pose::Translation(0, -2.7, 0));
    world.Given(2, Box{{0.1, 4.6, 2}}, Pose::Translation(0, 2.7, 0));
    GivenBut({opens_s, opens_s + 0.4}, world, 3, Box{{0.1, 1.2, 2}}, {});
    PlanTask task = AcrossThePlace();
    task.max_speed_mps = 4;
    task.time_limit = seconds(30);
    ExpectArrivesBy(opens_s + 1.6, world.Scene(), task);
  }
}

// Of a large place hardly anything can be visited on a short way.
TEST(SolveWindows, AShortWayInALargePlace) {
  TestWorld world;
  world.Given(1, Box{{0.2, 4, 2}}, Pose::Translation(0, 0, 0));
  PlanTask task = AcrossThePlace();
  task.area_W = {{-2000, -2000, 0}, {2000, 2000, 0}};
  task.start = {-1, 0};
  task.goal = {1, 0};
  task.time_limit = seconds(10);
  ExpectArrivesBy(6.5, world.Scene(), task);
}

TEST(SolveWindows, TheTimeIsTooShortForAWayRound) {
  TestWorld world;
  world.Given(1, Box{{0.2, 4, 2}}, Pose::Translation(0, 0, 0));
  PlanTask task = AcrossThePlace();
  task.time_limit = seconds(8);
  const Solved solved = SolveIn(world.Scene(), Disc(), task);
  ASSERT_TRUE(solved.outcome.ok()) << solved.outcome.status();
  EXPECT_EQ(solved.outcome->status, PlanStatus::kNoTimeToSpare);
}

// The elbow can be drawn in while the shoulder, which takes all of the time, goes at full speed.
TEST(SolveWindows, NoTimeIsToSpareButNoneIsNeeded) {
  PlanTask task = AcrossThePlace();
  task.start = {-1.5, 0};
  task.goal = {1.5, 0};
  task.time_limit = seconds(3);
  const Robot robot = PlaneArm(2, 0.5, 0.06, task);
  TestWorld world;
  world.Given(1, Cylinder{0.05, 1}, Pose::Translation(1, 0, 0));
  const ScenePtr scene = world.Scene();
  const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
  ExpectGood(solved, scene, robot, task);
}

// An arm of six joints in a plane, which a post keeps from swinging over: the first ways that are
// found take three times as long as the limit leaves.
TEST(SolveWindows, ATightLimitIsMet) {
  PlanTask task = AcrossThePlace();
  const Robot robot = PlaneArm(6, 0.3, 0.06, task);
  task.start = {-1, 0, 0, 0, 0, 0};
  task.goal = {1, 0, 0, 0, 0, 0};
  task.time_limit = std::chrono::milliseconds(2800);
  TestWorld world;
  world.Given(1, Cylinder{0.1, 1}, Pose::Translation(1.2, 0, 0));
  const ScenePtr scene = world.Scene();
  const Solved solved = SolveFor(kAnyTime_s, scene, robot, task);
  ExpectGood(solved, scene, robot, task);
}

}  // namespace
}  // namespace clearway
