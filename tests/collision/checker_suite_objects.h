// The part of CheckerSuite on moving objects and what is reported of several contacts.
#pragma once

#include <cmath>
#include <vector>

#include "collision/checker_fixture.h"

namespace clearway {

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

TYPED_TEST_P(CheckerSuite, GivenObjectsAreTheirShape) {
  for (const SolidMode mode : {SolidMode::kConvexHull, SolidMode::kVoxels}) {
    SceneParams params;
    params.solid = mode;
    const auto dut =
        this->Make(this->Room(params).Given(9, Cylinder{0.3, 1.8}, Pose{}), this->Ball());
    ExpectAnswer(this->Ask(*dut, At(0, 0, 0)), SpaceStatus::kOccupied, 0, 9);
    ExpectAnswer(this->Ask(*dut, At(0.549, 0, 0.8)), SpaceStatus::kOccupied, 0, 9);
    ExpectAnswer(this->Ask(*dut, At(0.554, 0, 0.8)), SpaceStatus::kFree, -1, 0);
    ExpectAnswer(this->Ask(*dut, At(0, 0, 1.149, 99)), SpaceStatus::kOccupied, 0, 9);
    ExpectAnswer(this->Ask(*dut, At(0, 0, 1.151, 99)), SpaceStatus::kFree, -1, 0);
  }
}

// There and back again, then on as it went; the motion that was seen last says otherwise.
TYPED_TEST_P(CheckerSuite, StatedFuturesAreFollowed) {
  SceneParams params;
  params.horizon = std::chrono::seconds(1);
  const std::vector<StampedPose> future = {{TestTime(2), Pose::Translation(-3, 2, 0)},
                                           {TestTime(4), Pose::Translation(-3, 0, 0)}};
  const auto dut =
      this->Make(this->Room(params)
                     .Object(3, VoxelCuboid({-2, -2, -2}, {2, 2, 2}), Pose::Translation(-3, 0, 0),
                             Twist{Eigen::Vector3d::Zero(), {1, 0, 0}})
                     .Future(future),
                 this->Ball());
  for (const double t : {1.0, 3.0}) {
    ExpectAnswer(this->Ask(*dut, At(-3, 1, 0, t)), SpaceStatus::kOccupied, 0, 3);
    ExpectAnswer(this->Ask(*dut, At(-3, 0, 0, t)), SpaceStatus::kFree, -1, 0);
    ExpectAnswer(this->Ask(*dut, At(-2, 0, 0, t)), SpaceStatus::kFree, -1, 0);
  }
  ExpectAnswer(this->Ask(*dut, At(-3, 2, 0, 2)), SpaceStatus::kOccupied, 0, 3);
  ExpectAnswer(this->Ask(*dut, At(-3, -1, 0, 5)), SpaceStatus::kOccupied, 0, 3);
  ExpectAnswer(this->Ask(*dut, At(-3, -1, 0, 6)), SpaceStatus::kBeyondHorizon, 0, 3);
  ExpectAnswer(this->Ask(*dut, At(-3, 2, 0, 6)), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, MotionsAreCheckedAgainstStatedFutures) {
  const std::vector<StampedPose> future = {{TestTime(1), Pose::Translation(0, 3, 0)},
                                           {TestTime(2), Pose{}},
                                           {TestTime(3), Pose::Translation(0, -3, 0)},
                                           {TestTime(4), Pose::Translation(0, -3, 0)}};
  const auto dut = this->Make(
      this->Room().Given(8, Box{{0.4, 0.4, 0.4}}, Pose::Translation(0, 3, 0), {}, future),
      this->Ball());
  const auto crosses_at = [&](double seconds) {  // x = 0, at 2 m/s
    MotionBatch motion{{2}, {TestTime(seconds - 0.5), TestTime(seconds + 0.5)}, {}, {}};
    motion.T_W_L = {Pose::Translation(-1, 0, 0), Pose::Translation(1, 0, 0)};
    const auto reply = dut->CheckMotions(motion, {});
    EXPECT_TRUE(reply.ok()) << reply.status();
    return reply->answers[0];
  };
  for (const double free_s : {0.6, 1.5, 2.5, 3.0, 50.0}) {
    EXPECT_EQ(crosses_at(free_s).status, SpaceStatus::kFree) << free_s;
  }
  const MotionAnswer hit = crosses_at(2);
  EXPECT_EQ(hit.status, SpaceStatus::kOccupied);
  ASSERT_TRUE(hit.witness);
  EXPECT_EQ(hit.witness->object, 8);
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
  ExpectAnswer(this->Ask(*dut, At(-0.34, 0, 0, -5), options), SpaceStatus::kOccupied, 0, 1);
}

TYPED_TEST_P(CheckerSuite, BoundsGrowWithTheTimeSinceAnObjectsLastPose) {
  const auto dut = this->Make(this->Room()
                                  .Object(1, VoxelCuboid({-1, -1, -1}, {1, 1, 1}), Pose{})
                                  .Bound({0.02, 0.04, 0.08}),
                              this->Ball());
  CheckOptions options;
  options.bound_multiple = 2;  // 0.04 m at once, 0.2 m after a second
  ExpectAnswer(this->Ask(*dut, At(-0.38, 0, 0, 0), options), SpaceStatus::kOccupied, 0, 1);
  ExpectAnswer(this->Ask(*dut, At(-0.40, 0, 0, 0), options), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, At(-0.54, 0, 0, 1), options), SpaceStatus::kOccupied, 0, 1);
  ExpectAnswer(this->Ask(*dut, At(-0.56, 0, 0, 1), options), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*dut, At(-0.36, 0, 0, -5), options), SpaceStatus::kFree, -1, 0);
}

TYPED_TEST_P(CheckerSuite, InflationMaySpareWhatIsKnownToRest) {
  const std::vector<VoxelKey> cube = VoxelCuboid({-1, -1, -1}, {1, 1, 1});
  const std::vector<StampedPose> here{{kTestStart, Pose{}}};
  const auto known = this->Make(this->Room().Object(1, cube, here, Twist{}), this->Ball());
  const auto unknown = this->Make(this->Room().Object(1, cube, here, std::nullopt), this->Ball());
  const StateBatch beside = At(-0.54, 0, 0, 1);
  CheckOptions options;
  options.inflation_mps = 0.2;
  ExpectAnswer(this->Ask(*known, beside, options), SpaceStatus::kOccupied, 0, 1);
  options.inflate_moving_only = true;
  ExpectAnswer(this->Ask(*known, beside, options), SpaceStatus::kFree, -1, 0);
  ExpectAnswer(this->Ask(*unknown, beside, options), SpaceStatus::kOccupied, 0, 1);
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

TYPED_TEST_P(CheckerSuite, EveryIdOfAnObjectNamesIt) {
  const std::vector<VoxelKey> cube = VoxelCuboid({-1, -1, -1}, {1, 1, 1});
  const auto dut = this->Make(this->Room().Object(4, cube, Pose{}).Also({7, 9}), this->Ball());
  CheckOptions options;
  ExpectAnswer(this->Ask(*dut, At(0, 0, 0), options), SpaceStatus::kOccupied, 0, 4);
  options.ignored_objects = {9};
  ExpectAnswer(this->Ask(*dut, At(0, 0, 0), options), SpaceStatus::kFree, -1, 0);
  options.ignored_objects = {};
  options.allowed_contacts = {{0, 7}};
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

}  // namespace clearway
