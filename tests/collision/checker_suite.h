// The one test suite for every StateChecker: local, mirrored and remote.
//
// A user defines a default-constructible type with
//   std::shared_ptr<const StateChecker> Make(ScenePtr scene, Robot robot);
// and says INSTANTIATE_TYPED_TEST_SUITE_P(Name, CheckerSuite, ThatType). Whatever the checker needs
// (a server, a mirror) lives as long as the checker or that object. Nothing but the interface is
// assumed: errors are compared by code, statuses exactly, clearances to 1e-6 m.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "clearway/collision/state_checker.h"
#include "collision/random_world.h"
#include "collision/test_world.h"

namespace clearway {

template <class Factory>
class CheckerSuite : public ::testing::Test {
 protected:
  std::shared_ptr<const StateChecker> Make(const TestWorld& world, Robot robot) {
    return factory_.Make(world.Scene(), std::move(robot));
  }
  // The answer to one state; an error fails the test.
  static StateAnswer Ask(const StateChecker& dut, const StateBatch& state,
                         const CheckOptions& options = {}) {
    const auto reply = dut.Check(state, options);
    EXPECT_TRUE(reply.ok()) << reply.status();
    if (!reply.ok() || reply->answers.size() != 1) return {};
    return reply->answers[0];
  }
  static CheckOptions UnknownIsFree() {
    CheckOptions options;
    options.unknown = UnknownPolicy::kFree;
    return options;
  }
  // 4 m of known free space each way, with a wall of occupied voxels at x = 2 to 2.1 m.
  static TestWorld Room(SceneParams params = {}) {
    TestWorld world(std::move(params));
    world.Free({{-4, -4, -4}, {4, 4, 4}}).Occupied({{2, -1, -1}, {2.1, 1, 1}});
    return world;
  }
  static Robot Ball(double radius_m = 0.25) { return Robot::SingleShape("ball", Sphere{radius_m}); }
  static Robot TwoBalls() {
    return {"two", {{"a", {{Sphere{0.25}, Pose{}}}}, {"b", {{Sphere{0.25}, Pose{}}}}}};
  }

  Factory factory_;
};

inline void ExpectAnswer(const StateAnswer& answer, SpaceStatus status, int link, ObjectId object) {
  EXPECT_EQ(answer.status, status) << ToString(answer.status);
  EXPECT_EQ(answer.link, link);
  EXPECT_EQ(answer.object, object);
}

TYPED_TEST_SUITE_P(CheckerSuite);

TYPED_TEST_P(CheckerSuite, Empty) {
  const auto dut = this->Make(this->Room(), this->Ball());
  const auto reply = dut->Check({}, {});
  ASSERT_TRUE(reply.ok()) << reply.status();
  EXPECT_TRUE(reply->answers.empty());
  EXPECT_EQ(reply->version, dut->version());
  EXPECT_EQ(reply->stamp, dut->stamp());
}

TYPED_TEST_P(CheckerSuite, NamesVersionStampAndRobot) {
  const auto dut = this->Make(this->Room(), this->Ball());
  EXPECT_EQ(dut->version(), 7u);
  EXPECT_EQ(dut->stamp(), kTestStart);
  EXPECT_EQ(RobotId(dut->robot()), RobotId(this->Ball()));
}

TYPED_TEST_P(CheckerSuite, KnownFreeSpaceIsFree) {
  const auto dut = this->Make(this->Room(), this->Ball());
  const StateAnswer answer = this->Ask(*dut, At(0, 0, 0));
  ExpectAnswer(answer, SpaceStatus::kFree, -1, kStaticLabel);
  EXPECT_EQ(answer.unknown_fraction, 0);
  EXPECT_FALSE(answer.clearance_m.has_value());
}

TYPED_TEST_P(CheckerSuite, StaticVoxelsOccupy) {
  const auto dut = this->Make(this->Room(), this->Ball());
  ExpectAnswer(this->Ask(*dut, At(1.76, 0, 0)), SpaceStatus::kOccupied, 0, kStaticLabel);
  ExpectAnswer(this->Ask(*dut, At(1.74, 0, 0)), SpaceStatus::kFree, -1, kStaticLabel);
}

TYPED_TEST_P(CheckerSuite, UnknownIsNotFreeUnlessAskedFor) {
  const auto dut = this->Make(TestWorld(), this->Ball());
  const StateAnswer blocked = this->Ask(*dut, At(0, 0, 0));
  ExpectAnswer(blocked, SpaceStatus::kUnknownSpace, 0, kStaticLabel);
  EXPECT_EQ(blocked.unknown_fraction, 1);
  const StateAnswer free = this->Ask(*dut, At(0, 0, 0), this->UnknownIsFree());
  ExpectAnswer(free, SpaceStatus::kFree, -1, kStaticLabel);
  EXPECT_EQ(free.unknown_fraction, 1);
}

TYPED_TEST_P(CheckerSuite, OneUnknownVoxelBlocks) {
  const TestWorld world = this->Room().Unknown({{0.41, 0.01, 0.01}, {0.49, 0.09, 0.09}});
  const auto dut = this->Make(world, this->Ball());
  ExpectAnswer(this->Ask(*dut, At(0.16, 0.05, 0.05)), SpaceStatus::kUnknownSpace, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(0.14, 0.05, 0.05)), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, UnknownIsToleratedUpToItsShare) {
  // A cube of 4 x 4 x 4 voxels, a quarter of them unknown.
  const TestWorld world = this->Room().Unknown({{0.1, -1, -1}, {0.2, 1, 1}});
  const auto dut =
      this->Make(world, Robot::SingleShape("cube", Box{Eigen::Vector3d::Constant(0.398)}));
  CheckOptions options;
  options.unknown = UnknownPolicy::kTolerated;
  options.max_unknown_fraction = 0.25;
  const StateAnswer answer = this->Ask(*dut, At(0, 0, 0), options);
  ExpectAnswer(answer, SpaceStatus::kFree, -1, 0);
  EXPECT_DOUBLE_EQ(answer.unknown_fraction, 0.25);
  options.max_unknown_fraction = 0.24;
  ExpectAnswer(this->Ask(*dut, At(0, 0, 0), options), SpaceStatus::kUnknownSpace, 0, 0);
}

TYPED_TEST_P(CheckerSuite, LinksThatShareVoxelsCountThemOnce) {
  const TestWorld world = this->Room().Unknown({{0.1, -1, -1}, {0.2, 1, 1}});
  const Shape cube = Box{Eigen::Vector3d::Constant(0.398)};
  const auto dut = this->Make(world, {"two", {{"a", {{cube, Pose{}}}}, {"b", {{cube, Pose{}}}}}});
  const StateBatch state{{kTestStart}, {Pose{}, Pose::Translation(-0.1, 0, 0)}};
  EXPECT_DOUBLE_EQ(this->Ask(*dut, state).unknown_fraction, 0.2);
}

TYPED_TEST_P(CheckerSuite, ARobotThinnerThanAVoxelIsJudgedByItsCenter) {
  const TestWorld world = this->Room().Unknown({{0.1, -1, -1}, {0.2, 1, 1}});
  const auto dut = this->Make(world, this->Ball(0.01));
  EXPECT_EQ(this->Ask(*dut, At(0.11, 0.01, 0.01)).unknown_fraction, 1);
  EXPECT_EQ(this->Ask(*dut, At(0.08, 0.01, 0.01)).unknown_fraction, 0);
}

TYPED_TEST_P(CheckerSuite, RegionsDeclaredFreeHideUnknownSpaceButNoObstacle) {
  const auto dut = this->Make(TestWorld().Occupied({{2, -1, -1}, {2.1, 1, 1}}), this->Ball());
  CheckOptions options;
  options.known_free_W = {{{-1, -1, -1}, {3, 1, 1}}};
  const StateAnswer answer = this->Ask(*dut, At(0, 0, 0), options);
  ExpectAnswer(answer, SpaceStatus::kFree, -1, 0);
  EXPECT_EQ(answer.unknown_fraction, 0);
  ExpectAnswer(this->Ask(*dut, At(1.9, 0, 0), options), SpaceStatus::kOccupied, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(-0.9, 0, 0), options), SpaceStatus::kUnknownSpace, 0, 0);
}

TYPED_TEST_P(CheckerSuite, LeavingTheBoundsComesFirst) {
  SceneParams params;
  params.bounds_W = {{-3, -3, -3}, {3, 3, 3}};
  const auto dut =
      this->Make(this->Room(params).Occupied({{2.5, -1, -1}, {3, 1, 1}}), this->TwoBalls());
  CheckOptions options;
  options.clearance_up_to_m = 1;
  const StateAnswer answer = this->Ask(
      *dut, {{kTestStart}, {Pose::Translation(2.5, 0, 0), Pose::Translation(2.76, 0, 0)}}, options);
  ExpectAnswer(answer, SpaceStatus::kOutOfBounds, 1, 0);
  EXPECT_EQ(answer.unknown_fraction, 1);
  EXPECT_EQ(answer.clearance_m, 0.0);
  ExpectAnswer(this->Ask(*dut, {{kTestStart}, {Pose::Translation(1e300, 0, 0), Pose{}}}),
               SpaceStatus::kOutOfBounds, 0, 0);
}

TYPED_TEST_P(CheckerSuite, KeepOutBoxesOccupy) {
  SceneParams params;
  params.keep_out_W = {{{-1.02, -1, -1}, {-0.98, 1, 1}}};
  const auto dut = this->Make(this->Room(params), this->Ball());
  ExpectAnswer(this->Ask(*dut, At(-0.74, 0, 0)), SpaceStatus::kOccupied, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(-0.72, 0, 0)), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, ObjectsAreWhereTheyWillBe) {
  const Twist forward{Eigen::Vector3d::Zero(), {0.5, 0, 0}};
  const auto dut = this->Make(this->Room().Object(3, VoxelCuboid({-2, -2, -2}, {2, 2, 2}),
                                                  Pose::Translation(-3, 0, 0), forward),
                              this->Ball());
  ExpectAnswer(this->Ask(*dut, At(-3, 0, 0, 0)), SpaceStatus::kOccupied, 0, 3);
  ExpectAnswer(this->Ask(*dut, At(-3, 0, 0, 2)), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, At(-2, 0, 0, 2)), SpaceStatus::kOccupied, 0, 3);
  ExpectAnswer(this->Ask(*dut, At(-2, 0, 0, 0)), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, ObjectsAreWhereTheyWere) {
  const std::vector<StampedPose> history = {{TestTime(-2), Pose::Translation(-2, 0, 0)},
                                            {TestTime(0), Pose{}}};
  const auto dut = this->Make(this->Room().Object(3, VoxelCuboid({-2, -2, -2}, {2, 2, 2}), history),
                              this->Ball());
  ExpectAnswer(this->Ask(*dut, At(-1, 0, 0, -1)), SpaceStatus::kOccupied, 0, 3);
  ExpectAnswer(this->Ask(*dut, At(-1, 0, 0, 0)), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, At(-2, 0, 0, -9)), SpaceStatus::kOccupied, 0, 3);
}

TYPED_TEST_P(CheckerSuite, BeyondTheHorizonAllThatIsInReachBlocks) {
  SceneParams params;
  params.horizon = std::chrono::seconds(1);
  const Twist forward{Eigen::Vector3d::Zero(), {1, 0, 0}};
  // At the horizon's end at x = -2; a second later the ball's radius is that of the solid and 1 m.
  const auto dut = this->Make(this->Room(params).Object(5, VoxelCuboid({-1, -1, -1}, {1, 1, 1}),
                                                        Pose::Translation(-3, 0, 0), forward),
                              this->Ball());
  const double reach_m = 1 + 0.1 * std::sqrt(3) + 0.25;
  ExpectAnswer(this->Ask(*dut, At(-2, 0, 0, 2)), SpaceStatus::kBeyondHorizon, 0, 5);
  ExpectAnswer(this->Ask(*dut, At(-2 + reach_m - 0.01, 0, 0, 2)), SpaceStatus::kBeyondHorizon, 0,
               5);
  ExpectAnswer(this->Ask(*dut, At(-2 + reach_m + 0.01, 0, 0, 2)), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, At(-2 + reach_m - 0.01, 0, 0, 1)), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, OccupiedComesBeforeBeyondHorizonBeforeUnknown) {
  SceneParams params;
  params.horizon = std::chrono::seconds(0);
  const Twist forward{Eigen::Vector3d::Zero(), {1, 0, 0}};
  const TestWorld world = TestWorld(params)
                              .Occupied({{1, -1, -1}, {1.1, 1, 1}})
                              .Object(5, VoxelCuboid({-1, -1, -1}, {1, 1, 1}), Pose{}, forward);
  const auto dut = this->Make(world, this->Ball());
  ExpectAnswer(this->Ask(*dut, At(1, 0, 0, 2)), SpaceStatus::kOccupied, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(0, 0, 0, 2)), SpaceStatus::kBeyondHorizon, 0, 5);
  ExpectAnswer(this->Ask(*dut, At(0, 0, 3, 2)), SpaceStatus::kUnknownSpace, 0, 0);
}

TYPED_TEST_P(CheckerSuite, TheInsideOfAnObjectIsItsHullOrItsVoxelsAlone) {
  std::vector<VoxelKey> two_walls = VoxelCuboid({-8, -8, -8}, {-7, 8, 8});
  for (const VoxelKey& key : VoxelCuboid({7, -8, -8}, {8, 8, 8})) two_walls.push_back(key);
  SceneParams params;
  const auto hull = this->Make(this->Room(params).Object(1, two_walls, Pose{}), this->Ball());
  ExpectAnswer(this->Ask(*hull, At(0, 0, 0)), SpaceStatus::kOccupied, 0, 1);
  params.solid = SolidMode::kVoxels;
  const auto voxels = this->Make(this->Room(params).Object(1, two_walls, Pose{}), this->Ball());
  ExpectAnswer(this->Ask(*voxels, At(0, 0, 0)), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*voxels, At(0.5, 0, 0)), SpaceStatus::kOccupied, 0, 1);
}

TYPED_TEST_P(CheckerSuite, PaddingGrowsTheRobot) {
  const auto dut = this->Make(this->Room(), this->Ball());
  CheckOptions options;
  options.padding_m = 0.3;
  ExpectAnswer(this->Ask(*dut, At(1.46, 0, 0), options), SpaceStatus::kOccupied, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(1.44, 0, 0), options), SpaceStatus::kFree, -1, 0);
  // Unknown space begins at -4.
  ExpectAnswer(this->Ask(*dut, At(-3.46, 0, 0), options), SpaceStatus::kUnknownSpace, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(-3.44, 0, 0), options), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, InflationGrowsWithTheTimeSinceAnObjectWasPlaced) {
  const auto dut = this->Make(this->Room().Object(1, VoxelCuboid({-1, -1, -1}, {1, 1, 1}), Pose{}),
                              this->Ball());
  CheckOptions options;
  options.inflation_mps = 0.2;
  ExpectAnswer(this->Ask(*dut, At(-0.36, 0, 0, 0), options), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, At(-0.54, 0, 0, 1), options), SpaceStatus::kOccupied, 0, 1);
  ExpectAnswer(this->Ask(*dut, At(-0.56, 0, 0, 1), options), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, At(-0.36, 0, 0, -5), options), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, IgnoredObjectsAreNotThere) {
  const std::vector<VoxelKey> cube = VoxelCuboid({-1, -1, -1}, {1, 1, 1});
  const auto dut =
      this->Make(this->Room().Object(1, cube, Pose{}).Object(2, cube, Pose{}), this->Ball());
  CheckOptions options;
  options.ignored_objects = {1, 99};
  ExpectAnswer(this->Ask(*dut, At(0, 0, 0), options), SpaceStatus::kOccupied, 0, 2);
  options.ignored_objects = {2, 1};
  ExpectAnswer(this->Ask(*dut, At(0, 0, 0), options), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, AllowedContactsHoldForTheirLinkAlone) {
  const auto dut = this->Make(this->Room().Object(4, VoxelCuboid({-1, -1, -1}, {1, 1, 1}), Pose{}),
                              this->TwoBalls());
  const StateBatch both_in_object{{kTestStart}, {Pose{}, Pose{}}};
  const StateBatch first_in_wall{{kTestStart}, {Pose::Translation(2, 0, 0), Pose{}}};
  CheckOptions options;
  options.allowed_contacts = {{0, 4}};
  ExpectAnswer(this->Ask(*dut, both_in_object, options), SpaceStatus::kOccupied, 1, 4);
  options.allowed_contacts = {{0, 4}, {1, 4}};
  ExpectAnswer(this->Ask(*dut, both_in_object, options), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, first_in_wall, options), SpaceStatus::kOccupied, 0, 0);
  options.allowed_contacts = {{0, 0}};
  ExpectAnswer(this->Ask(*dut, first_in_wall, options), SpaceStatus::kOccupied, 1, 4);
}

TYPED_TEST_P(CheckerSuite, TheLowestLinkThenObjectIsReported) {
  const std::vector<VoxelKey> cube = VoxelCuboid({-1, -1, -1}, {1, 1, 1});
  const auto dut =
      this->Make(this->Room().Object(2, cube, Pose{}).Object(6, cube, Pose{}), this->TwoBalls());
  ExpectAnswer(this->Ask(*dut, {{kTestStart}, {Pose{}, Pose::Translation(2, 0, 0)}}),
               SpaceStatus::kOccupied, 0, 2);
  ExpectAnswer(this->Ask(*dut, {{kTestStart}, {Pose::Translation(2, 0, 0), Pose{}}}),
               SpaceStatus::kOccupied, 0, 0);
  ExpectAnswer(this->Ask(*dut, {{kTestStart}, {Pose::Translation(1, 0, 0), Pose{}}}),
               SpaceStatus::kOccupied, 1, 2);
}

TYPED_TEST_P(CheckerSuite, ClearanceIsTheDistanceToWhatBlocks) {
  const auto dut = this->Make(
      this->Room().Object(1, VoxelCuboid({-1, -1, -1}, {1, 1, 1}), Pose::Translation(0, 2, 0)),
      this->Ball());
  CheckOptions options;
  options.clearance_up_to_m = 10;
  EXPECT_NEAR(this->Ask(*dut, At(1, 0, 0), options).clearance_m.value(), 0.75, 1e-6);
  EXPECT_NEAR(this->Ask(*dut, At(0, 1, 0), options).clearance_m.value(), 0.65, 1e-6);
  EXPECT_NEAR(this->Ask(*dut, At(-3, 0, 0), options).clearance_m.value(), 0.75, 1e-6);
  EXPECT_EQ(this->Ask(*dut, At(2, 0, 0), options).clearance_m, 0.0);
  options.unknown = UnknownPolicy::kFree;
  EXPECT_NEAR(this->Ask(*dut, At(-3, 0, 0), options).clearance_m.value(),
              std::hypot(2.9, 1.9) - 0.25, 1e-6);
  options.padding_m = 0.1;
  EXPECT_NEAR(this->Ask(*dut, At(1, 0, 0), options).clearance_m.value(), 0.65, 1e-6);
}

TYPED_TEST_P(CheckerSuite, ClearanceEndsWhereItWasAskedTo) {
  const auto dut = this->Make(TestWorld(), this->Ball());
  CheckOptions options = this->UnknownIsFree();
  options.clearance_up_to_m = 1.5;
  EXPECT_DOUBLE_EQ(this->Ask(*dut, At(0, 0, 0), options).clearance_m.value(), 1.5);
  options.clearance_up_to_m = 0;
  EXPECT_EQ(this->Ask(*dut, At(0, 0, 0), options).clearance_m, 0.0);
}

TYPED_TEST_P(CheckerSuite, EveryShapeReachesAsFarAsItShould) {
  const std::vector<std::pair<Shape, double>> shapes = {
      {Sphere{0.3}, 0.3},
      {Box{{0.6, 0.2, 0.2}}, 0.3},
      {Capsule{0.3, 0.5}, 0.3},
      {Cylinder{0.3, 0.5}, 0.3},
      {ConvexPolytope{CubeMesh(0.3)}, 0.3},
      {TriangleMesh{CubeMesh(0.3)}, 0.3},
  };
  for (const auto& [shape, reach_m] : shapes) {
    const auto dut = this->Make(this->Room(), Robot::SingleShape("shape", shape));
    ExpectAnswer(this->Ask(*dut, At(2.001 - reach_m, 0, 0)), SpaceStatus::kOccupied, 0, 0);
    ExpectAnswer(this->Ask(*dut, At(1.999 - reach_m, 0, 0)), SpaceStatus::kFree, -1, 0);
    CheckOptions options;
    options.clearance_up_to_m = 1;
    EXPECT_NEAR(this->Ask(*dut, At(1.5, 0, 0), options).clearance_m.value(), 0.5 - reach_m, 1e-6);
  }
}

TYPED_TEST_P(CheckerSuite, AClosedMeshIsSolid) {
  const std::vector<VoxelKey> cube = VoxelCuboid({-1, -1, -1}, {1, 1, 1});
  const TestWorld world = this->Room()
                              .Object(1, cube, Pose::Translation(0, 3, 0))
                              .Occupied({{-2.1, 0, 0}, {-2, 0.1, 0.1}});
  const auto dut = this->Make(world, Robot::SingleShape("crate", TriangleMesh{CubeMesh(0.5)}));
  ExpectAnswer(this->Ask(*dut, At(-2, 0, 0)), SpaceStatus::kOccupied, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(0, 3, 0)), SpaceStatus::kOccupied, 0, 1);
}

TYPED_TEST_P(CheckerSuite, PosesOfShapesInTheirLinkCount) {
  Robot robot = this->Ball();
  robot.links[0].shapes[0].T_L_G = Pose::Translation(1, 0, 0);
  const auto dut = this->Make(this->Room(), robot);
  ExpectAnswer(this->Ask(*dut, At(1, 0, 0)), SpaceStatus::kOccupied, 0, 0);
  ExpectAnswer(this->Ask(*dut, At(2, 0, 0)), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, AnswersComeInTheOrderOfTheStates) {
  const Twist forward{Eigen::Vector3d::Zero(), {0.5, 0, 0}};
  const auto dut = this->Make(this->Room().Object(3, VoxelCuboid({-2, -2, -2}, {2, 2, 2}),
                                                  Pose::Translation(-3, 0, 0), forward),
                              this->Ball());
  const Pose there = Pose::Translation(-2, 0, 0);
  const auto reply =
      dut->Check({{TestTime(2), TestTime(0), TestTime(2)}, {there, there, Pose{}}}, {});
  ASSERT_TRUE(reply.ok()) << reply.status();
  ASSERT_EQ(reply->answers.size(), 3u);
  ExpectAnswer(reply->answers[0], SpaceStatus::kOccupied, 0, 3);
  ExpectAnswer(reply->answers[1], SpaceStatus::kFree, -1, 0);
  ExpectAnswer(reply->answers[2], SpaceStatus::kFree, -1, 0);
}

inline void ExpectSameAnswers(const CheckReply& a, const CheckReply& b) {
  ASSERT_EQ(a.answers.size(), b.answers.size());
  for (std::size_t s = 0; s < a.answers.size(); ++s) {
    EXPECT_EQ(a.answers[s].status, b.answers[s].status) << "state " << s;
    EXPECT_EQ(a.answers[s].link, b.answers[s].link) << "state " << s;
    EXPECT_EQ(a.answers[s].object, b.answers[s].object) << "state " << s;
    EXPECT_DOUBLE_EQ(a.answers[s].unknown_fraction, b.answers[s].unknown_fraction);
    ASSERT_EQ(a.answers[s].clearance_m.has_value(), b.answers[s].clearance_m.has_value());
    EXPECT_NEAR(a.answers[s].clearance_m.value_or(0), b.answers[s].clearance_m.value_or(0), 1e-9);
  }
}

TYPED_TEST_P(CheckerSuite, AnswersAreThoseOfTheLocalChecker) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    RandomWorld random(seed);
    const ScenePtr scene = random.Scene();
    const Robot robot = random.AnyRobot();
    const StateBatch states = random.States(robot, 60);
    const CheckOptions options = random.Options(robot);
    const auto dut = this->factory_.Make(scene, robot);
    const auto reply = dut->Check(states, options);
    ASSERT_TRUE(reply.ok()) << reply.status();
    const auto expected = SceneChecker(scene, robot).Check(states, options);
    ASSERT_TRUE(expected.ok()) << expected.status();
    ExpectSameAnswers(*reply, *expected);
  }
}

TYPED_TEST_P(CheckerSuite, ManyThreadsGetTheSameAnswers) {
  RandomWorld random(11);
  const ScenePtr scene = random.Scene();
  const Robot robot = random.AnyRobot();
  const StateBatch states = random.States(robot, 60);
  const CheckOptions options = random.Options(robot);
  const auto dut = this->factory_.Make(scene, robot);
  const auto alone = dut->Check(states, options);
  ASSERT_TRUE(alone.ok()) << alone.status();
  std::vector<absl::StatusOr<CheckReply>> replies(4, absl::UnknownError("not asked"));
  std::vector<std::thread> threads;
  for (auto& reply : replies) {
    threads.emplace_back([&] { reply = dut->Check(states, options); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& reply : replies) {
    ASSERT_TRUE(reply.ok()) << reply.status();
    ExpectSameAnswers(*reply, *alone);
  }
}

TYPED_TEST_P(CheckerSuite, RefusesBatchesThatDoNotFit) {
  const auto dut = this->Make(this->Room(), this->TwoBalls());
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Pose stretched, not_finite = Pose::Translation(kNaN, 0, 0), infinite, zero;
  stretched.rotation.coeffs() << 0, 0, 0, 1.1;
  infinite.translation.x() = std::numeric_limits<double>::infinity();
  zero.rotation.coeffs().setZero();
  const std::vector<StateBatch> refused = {
      {{kTestStart}, {}},
      {{}, {Pose{}, Pose{}}},
      {{kTestStart}, {Pose{}}},
      {{kTestStart}, {Pose{}, Pose{}, Pose{}}},
      {{kTestStart}, {Pose{}, stretched}},
      {{kTestStart}, {Pose{}, not_finite}},
      {{kTestStart}, {infinite, Pose{}}},
      {{kTestStart}, {zero, Pose{}}},
      {{Time::min()}, {Pose{}, Pose{}}},
      {{Time::max()}, {Pose{}, Pose{}}},
  };
  for (std::size_t i = 0; i < refused.size(); ++i) {
    const auto reply = dut->Check(refused[i], {});
    EXPECT_EQ(reply.status().code(), absl::StatusCode::kInvalidArgument) << "batch " << i;
  }
}

TYPED_TEST_P(CheckerSuite, RefusesOptionsOutOfRange) {
  const auto dut = this->Make(this->Room(), this->TwoBalls());
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(CheckOptions&)>> spoilers = {
      [](CheckOptions& o) { o.padding_m = -0.1; },
      [](CheckOptions& o) { o.padding_m = kNaN; },
      [](CheckOptions& o) { o.inflation_mps = -1; },
      [](CheckOptions& o) { o.max_unknown_fraction = 1.5; },
      [](CheckOptions& o) { o.clearance_up_to_m = -1; },
      [](CheckOptions& o) { o.clearance_up_to_m = kNaN; },
      [](CheckOptions& o) {
        o.known_free_W = {{{1, 0, 0}, {0, 1, 1}}};
      },
      [](CheckOptions& o) {
        o.known_free_W = {{{kNaN, 0, 0}, {0, 1, 1}}};
      },
      [](CheckOptions& o) { o.ignored_objects = {0}; },
      [](CheckOptions& o) {
        o.allowed_contacts = {{2, 1}};
      },
      [](CheckOptions& o) {
        o.allowed_contacts = {{-1, 1}};
      },
      [](CheckOptions& o) {
        o.allowed_contacts = {{0, -1}};
      },
  };
  for (std::size_t i = 0; i < spoilers.size(); ++i) {
    CheckOptions options;
    options.unknown = UnknownPolicy::kTolerated;
    spoilers[i](options);
    const auto reply = dut->Check({{kTestStart}, {Pose{}, Pose{}}}, options);
    EXPECT_EQ(reply.status().code(), absl::StatusCode::kInvalidArgument) << "options " << i;
  }
}

REGISTER_TYPED_TEST_SUITE_P(
    CheckerSuite, Empty, NamesVersionStampAndRobot, KnownFreeSpaceIsFree, StaticVoxelsOccupy,
    UnknownIsNotFreeUnlessAskedFor, OneUnknownVoxelBlocks, UnknownIsToleratedUpToItsShare,
    LinksThatShareVoxelsCountThemOnce, ARobotThinnerThanAVoxelIsJudgedByItsCenter,
    RegionsDeclaredFreeHideUnknownSpaceButNoObstacle, LeavingTheBoundsComesFirst,
    KeepOutBoxesOccupy, ObjectsAreWhereTheyWillBe, ObjectsAreWhereTheyWere,
    BeyondTheHorizonAllThatIsInReachBlocks, OccupiedComesBeforeBeyondHorizonBeforeUnknown,
    TheInsideOfAnObjectIsItsHullOrItsVoxelsAlone, PaddingGrowsTheRobot,
    InflationGrowsWithTheTimeSinceAnObjectWasPlaced, IgnoredObjectsAreNotThere,
    AllowedContactsHoldForTheirLinkAlone, TheLowestLinkThenObjectIsReported,
    ClearanceIsTheDistanceToWhatBlocks, ClearanceEndsWhereItWasAskedTo,
    EveryShapeReachesAsFarAsItShould, AClosedMeshIsSolid, PosesOfShapesInTheirLinkCount,
    AnswersComeInTheOrderOfTheStates, AnswersAreThoseOfTheLocalChecker,
    ManyThreadsGetTheSameAnswers, RefusesBatchesThatDoNotFit, RefusesOptionsOutOfRange);

}  // namespace clearway
