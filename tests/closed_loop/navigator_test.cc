#include "closed_loop/navigator.h"

#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "closed_loop/scene_feed.h"

namespace clearway::closed_loop {
namespace {

// From the origin 4 m along x, which takes 2.7 s.
Errand Ahead() {
  Errand errand;
  errand.goal_W = {4, 0};
  errand.area_W = {{-2, -3, -1}, {6, 3, 3}};
  return errand;
}

// A person who is at `p_W` at time 0 and nearly stands still.
ScenePtr SceneWithPerson(const Eigen::Vector2d& p_W) {
  ThreadPool pool(1);
  SceneBuilder builder(LoopSceneParams(), FrameLimits(), pool);
  GivenObject person;
  person.id = 1;
  person.shape = Cylinder{0.3, 1.7};
  person.pose = {Time(), Pose::Translation(p_W.x(), p_W.y(), 0.85)};
  person.velocity_O = Twist{.linear = {0.01, 0, 0}};
  const std::vector<GivenObject> given{person};
  EXPECT_TRUE(builder.AddObjects(given).ok());
  return builder.Publish();
}

NavigatorOptions Inflating(double now_mps, std::optional<double> later_mps) {
  NavigatorOptions options;
  options.inflation_mps = now_mps;
  options.later_inflation_mps = later_mps;
  return options;
}

const TimedPath::Knot kStart{Time(), {0, 0}};

TEST(NavigatorTest, EmptySceneGoesStraight) {
  Navigator dut(Ahead(), {});
  ThreadPool pool(1);
  SceneBuilder builder(LoopSceneParams(), FrameLimits(), pool);
  const Decision decision = dut.Decide(builder.Publish(), kStart);
  EXPECT_EQ(decision.choice, Choice::kPlanned);
  EXPECT_EQ(decision.path.end_W(), Eigen::Vector2d(4, 0));
  EXPECT_NEAR(ToSeconds(decision.path.end_time() - Time()), 4 / 1.5, 0.01);
}

// Behind the goal: by the time that the robot is there it might be anywhere within 3 m.
TEST(NavigatorTest, WhatIsLaterMayBeInflatedLess) {
  const ScenePtr scene = SceneWithPerson({7.5, 0});
  Navigator careful(Ahead(), Inflating(1, std::nullopt)), dut(Ahead(), Inflating(1, 0.1));
  EXPECT_EQ(careful.Decide(scene, kStart).choice, Choice::kEvaded);
  EXPECT_EQ(dut.Decide(scene, kStart).choice, Choice::kPlanned);
}

// Between start and goal, 1.5 s away: nothing is gained by what is later.
TEST(NavigatorTest, TheNextTwoSecondsAreInflatedInFull) {
  const ScenePtr scene = SceneWithPerson({2.5, 0});
  Navigator dut(Ahead(), Inflating(2, 0));
  EXPECT_EQ(dut.Decide(scene, kStart).choice, Choice::kEvaded);
}

TEST(NavigatorTest, AWayIsGoodUntilSomethingIsInIt) {
  Navigator dut(Ahead(), Inflating(0.1, std::nullopt));
  EXPECT_FALSE(dut.StillGood(SceneWithPerson({0, 5}), kStart));  // there is none yet
  EXPECT_EQ(dut.Decide(SceneWithPerson({0, 5}), kStart).choice, Choice::kPlanned);
  EXPECT_TRUE(dut.StillGood(SceneWithPerson({0, 5}), kStart));
  EXPECT_FALSE(dut.StillGood(SceneWithPerson({2, 0}), kStart));
}

}  // namespace
}  // namespace clearway::closed_loop
