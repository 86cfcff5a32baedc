// The local checker against brute force, on random scenes.
#include "clearway/collision/scene_checker.h"

#include <gtest/gtest.h>

#include <array>
#include <iostream>

#include "collision/brute_force.h"
#include "collision/random_world.h"

namespace clearway {
namespace {

// How many states had which answer, so that no test passes for want of cases.
struct Tally {
  int states = 0;
  int unsure = 0;
  std::array<int, 6> by_status{};
  int with_object = 0;
  int clearances_between = 0;  // neither 0 nor at their limit

  void Add(const StateAnswer& answer, const CheckOptions& options) {
    ++by_status[static_cast<std::size_t>(answer.status)];
    with_object += answer.object > 0;
    clearances_between += answer.clearance_m && *answer.clearance_m > 0 &&
                          *answer.clearance_m < *options.clearance_up_to_m;
  }
  int Of(SpaceStatus status) const { return by_status[static_cast<std::size_t>(status)]; }
};

void Compare(const StateAnswer& dut, const StateAnswer& expected, const std::string& where) {
  ASSERT_EQ(ToString(dut.status), std::string(ToString(expected.status))) << where;
  ASSERT_EQ(dut.link, expected.link) << where;
  ASSERT_EQ(dut.object, expected.object) << where;
  ASSERT_DOUBLE_EQ(dut.unknown_fraction, expected.unknown_fraction) << where;
  ASSERT_EQ(dut.clearance_m.has_value(), expected.clearance_m.has_value()) << where;
  ASSERT_NEAR(dut.clearance_m.value_or(0), expected.clearance_m.value_or(0), 1e-6) << where;
}

void CheckAgainstBruteForce(RandomWorld& random, const ScenePtr& scene, const Robot& robot,
                            int count, Tally& tally, const std::string& name) {
  const Aabb region{{-3.1, -3.1, -2.3}, {3.1, 3.1, 2.3}};
  const StateBatch states = random.States(robot, count);
  const CheckOptions options = random.Options(robot);
  const auto reply = SceneChecker(scene, robot).Check(states, options);
  ASSERT_TRUE(reply.ok()) << reply.status();
  const BruteForce brute_force(scene, robot, options, region);
  for (int s = 0; s < count; ++s) {
    const BruteAnswer expected =
        brute_force.Check(states.times[s], &states.T_W_L[s * robot.links.size()]);
    ++tally.states;
    tally.unsure += expected.unsure;
    tally.Add(expected.answer, options);
    if (expected.unsure) continue;
    Compare(reply->answers[s], expected.answer, name + ", state " + std::to_string(s));
    if (::testing::Test::HasFatalFailure()) return;
  }
}

void ExpectEveryAnswerOccurred(const Tally& tally) {
  std::cout << tally.states << " states, " << tally.unsure
            << " within 1e-6 m of touching left out; " << tally.with_object << " met an object\n";
  EXPECT_LE(tally.unsure, tally.states / 500);
  for (SpaceStatus status :
       {SpaceStatus::kFree, SpaceStatus::kUnknownSpace, SpaceStatus::kBeyondHorizon,
        SpaceStatus::kOccupied, SpaceStatus::kOutOfBounds}) {
    EXPECT_GT(tally.Of(status), tally.states / 200) << ToString(status);
  }
  EXPECT_GT(tally.with_object, tally.states / 20);
  EXPECT_GT(tally.clearances_between, tally.states / 50);
}

TEST(SceneCheckerTest, AgreesWithBruteForceForEveryShape) {
  Tally tally;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    RandomWorld random(1000 + seed);
    const ScenePtr scene = random.Scene();
    const std::size_t kind = seed % std::variant_size_v<Shape>;
    const Robot robot = Robot::SingleShape("one", random.ShapeOfKind(kind));
    CheckAgainstBruteForce(random, scene, robot, 40, tally,
                           "seed " + std::to_string(seed) + ", kind " + std::to_string(kind));
  }
  ExpectEveryAnswerOccurred(tally);
}

TEST(SceneCheckerTest, AgreesWithBruteForceForManyLinks) {
  Tally tally;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    RandomWorld random(seed);
    const ScenePtr scene = random.Scene();
    CheckAgainstBruteForce(random, scene, random.AnyRobot(), 30, tally,
                           "seed " + std::to_string(seed));
  }
  ExpectEveryAnswerOccurred(tally);
}

}  // namespace
}  // namespace clearway
