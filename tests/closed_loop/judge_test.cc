#include "closed_loop/judge.h"

#include <gtest/gtest.h>

#include "closed_loop/robot.h"

namespace clearway::closed_loop {
namespace {

// A person who comes along x at 1 m/s and is at the origin after 5 s.
World Walker() {
  return World(
      {Body::Single(7, "person", Cylinder{0.3, 1.7},
                    ConstantTwist{Pose::Translation(-5, 0, 0.85), {.linear = {1, 0, 0}}, Time()})});
}

// Looks at the robot at rest in a place, every 10 ms of 10 s.
void StandAt(const Eigen::Vector2d& p_W, Judge& judge) {
  for (int i = 0; i <= 1000; ++i) judge.Look(p_W, Time(FromSeconds(0.01 * i)));
}

TEST(JudgeTest, Empty) {
  const World nothing;
  Judge dut(nothing, Carrier());
  StandAt({0, 0}, dut);
  EXPECT_TRUE(dut.collisions().empty());
}

TEST(JudgeTest, FindsTheFirstContactOnce) {
  const World world = Walker();
  Judge dut(world, Carrier());
  const ObjectId seen[] = {0, 7};
  dut.Saw(seen, Time(FromSeconds(2)));
  dut.Saw(seen, Time(FromSeconds(3)));
  StandAt({0, 0}, dut);
  ASSERT_EQ(dut.collisions().size(), 1u);
  const Collision& collision = dut.collisions()[0];
  EXPECT_EQ(collision.object, 7);
  EXPECT_NEAR(ToSeconds(collision.time - Time()), 4.4, 0.011);  // 0.6 m apart
  EXPECT_NEAR(ToSeconds(*collision.seen_before), 2.4, 0.011);
  EXPECT_TRUE(collision.InTime());
}

TEST(JudgeTest, TellsWhoWasSeenLateOrNever) {
  const World world = Walker();
  Judge late(world, Carrier()), never(world, Carrier());
  const ObjectId seen[] = {7};
  late.Saw(seen, Time(FromSeconds(3.5)));
  StandAt({0, 0}, late);
  StandAt({0, 0}, never);
  EXPECT_FALSE(late.collisions().at(0).InTime());
  EXPECT_FALSE(never.collisions().at(0).seen_before);
  EXPECT_FALSE(never.collisions().at(0).InTime());
}

TEST(JudgeTest, PassingByIsNoCollision) {
  const World world = Walker();
  Judge dut(world, Carrier());
  StandAt({0, 0.61}, dut);
  EXPECT_TRUE(dut.collisions().empty());
}

}  // namespace
}  // namespace clearway::closed_loop
