// The local checker against brute force, on random scenes.
#include "clearway/collision/scene_checker.h"

#include <gtest/gtest.h>

#include <string>

#include "collision/brute_force.h"
#include "collision/random_world.h"
#include "collision/tally.h"
#include "collision/test_meshes.h"
#include "collision/test_world.h"

namespace clearway {
namespace {

void CheckAgainstBruteForce(RandomWorld& random, const ScenePtr& scene, const Robot& robot,
                            int count, Tally& tally, const std::string& name) {
  const Aabb region{{-3.1, -3.1, -2.3}, {3.1, 3.1, 2.3}};
  const StateBatch states = random.States(robot, count);
  const CheckOptions options = random.Options(robot);
  const auto reply = SceneChecker(scene, robot).Check(states, options);
  ASSERT_TRUE(reply.ok()) << reply.status();
  const BruteForce brute_force(scene, robot, options, region);
  for (int s = 0; s < count; ++s) {
    tally.Compare(reply->answers[s],
                  brute_force.Check(states.times[s], &states.T_W_L[s * robot.links.size()]),
                  options, name + ", state " + std::to_string(s));
  }
}

void ExpectEveryAnswerOccurred(const Tally& tally) {
  tally.Print();
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

TEST(SceneCheckerTest, AgreesWithBruteForceForMeshesOfAllKinds) {
  Tally tally;
  std::uint32_t seed = 2000;
  for (const TestMesh& test : TestMeshes()) {
    if (test.size_m > 1) continue;  // never within the bounds
    RandomWorld random(++seed);
    const ScenePtr scene = random.Scene();
    const Robot robot = Robot::SingleShape(test.name, TriangleMesh{test.regular});
    CheckAgainstBruteForce(random, scene, robot, 40, tally, test.name);
  }
  ExpectEveryAnswerOccurred(tally);
}

TEST(SceneCheckerTest, OnePreparedRobotServesTheCheckersOfManyScenes) {
  RandomWorld random(3);
  const Robot robot = random.AnyRobot();
  const auto prepared = std::make_shared<const PreparedRobot>(robot);
  for (int i = 0; i < 5; ++i) {
    const ScenePtr scene = random.Scene();
    const StateBatch states = random.States(robot, 30);
    const CheckOptions options = random.Options(robot);
    const auto dut = SceneChecker(scene, prepared).Check(states, options);
    const auto expected = SceneChecker(scene, robot).Check(states, options);
    ASSERT_TRUE(dut.ok() && expected.ok());
    for (std::size_t s = 0; s < states.times.size(); ++s) {
      EXPECT_EQ(dut->answers[s].status, expected->answers[s].status);
      EXPECT_EQ(dut->answers[s].clearance_m, expected->answers[s].clearance_m);
    }
  }
}

// A state of 80 million voxels would take many seconds.
TEST(SceneCheckerTest, EndsSoonOnceItIsCancelled) {
  const SceneChecker dut(TestWorld().Scene(), Robot::SingleShape("huge", Sphere{27}));
  int looks = 0;
  const auto reply = dut.Check({{kTestStart}, {Pose{}}}, {}, [&] { return ++looks > 50; });
  EXPECT_TRUE(absl::IsCancelled(reply.status())) << reply.status();
  EXPECT_LT(looks, 60);
}

}  // namespace
}  // namespace clearway
