// The part of CheckerSuite on the static map, unknown space, shapes and clearance.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "collision/checker_fixture.h"

namespace clearway {

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
  EXPECT_FALSE(answer.unknown_fraction.has_value());
  EXPECT_EQ(this->Ask(*dut, At(0, 0, 0), this->WithUnknownFraction()).unknown_fraction, 0);
  EXPECT_FALSE(answer.clearance_m.has_value());
}

TYPED_TEST_P(CheckerSuite, StaticVoxelsOccupy) {
  const auto dut = this->Make(this->Room(), this->Ball());
  ExpectAnswer(this->Ask(*dut, At(1.76, 0, 0)), SpaceStatus::kOccupied, 0, kStaticLabel);
  ExpectAnswer(this->Ask(*dut, At(1.74, 0, 0)), SpaceStatus::kFree, -1, kStaticLabel);
}

TYPED_TEST_P(CheckerSuite, UnknownIsNotFreeUnlessAskedFor) {
  const auto dut = this->Make(TestWorld(), this->Ball());
  CheckOptions options = this->WithUnknownFraction();
  const StateAnswer blocked = this->Ask(*dut, At(0, 0, 0), options);
  ExpectAnswer(blocked, SpaceStatus::kUnknownSpace, 0, kStaticLabel);
  EXPECT_EQ(blocked.unknown_fraction, 1);
  options.unknown = UnknownPolicy::kFree;
  const StateAnswer free = this->Ask(*dut, At(0, 0, 0), options);
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
  EXPECT_EQ(answer.unknown_fraction, 0.25);
  options.max_unknown_fraction = 0.24;
  ExpectAnswer(this->Ask(*dut, At(0, 0, 0), options), SpaceStatus::kUnknownSpace, 0, 0);
}

TYPED_TEST_P(CheckerSuite, LinksThatShareVoxelsCountThemOnce) {
  const TestWorld world = this->Room().Unknown({{0.1, -1, -1}, {0.2, 1, 1}});
  const Shape cube = Box{Eigen::Vector3d::Constant(0.398)};
  const auto dut = this->Make(world, {"two", {{"a", {{cube, Pose{}}}}, {"b", {{cube, Pose{}}}}}});
  const StateBatch state{{kTestStart}, {Pose{}, Pose::Translation(-0.1, 0, 0)}};
  EXPECT_EQ(this->Ask(*dut, state, this->WithUnknownFraction()).unknown_fraction, 0.2);
}

TYPED_TEST_P(CheckerSuite, ARobotThinnerThanAVoxelIsJudgedByItsCenter) {
  const TestWorld world = this->Room().Unknown({{0.1, -1, -1}, {0.2, 1, 1}});
  const auto dut = this->Make(world, this->Ball(0.01));
  EXPECT_EQ(this->Ask(*dut, At(0.11, 0.01, 0.01), this->WithUnknownFraction()).unknown_fraction, 1);
  EXPECT_EQ(this->Ask(*dut, At(0.08, 0.01, 0.01), this->WithUnknownFraction()).unknown_fraction, 0);
}

TYPED_TEST_P(CheckerSuite, RegionsDeclaredFreeHideUnknownSpaceButNoObstacle) {
  const auto dut = this->Make(TestWorld().Occupied({{2, -1, -1}, {2.1, 1, 1}}), this->Ball());
  CheckOptions options = this->WithUnknownFraction();
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
  CheckOptions options = this->WithUnknownFraction();
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

}  // namespace clearway
