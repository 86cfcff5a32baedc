// The velocity of steps whose heading is wrong.
#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "scene/object_motion.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::At;

Pose TurnedBy(double rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitZ())),
          Eigen::Vector3d::Zero()};
}

// A car at 2 m/s along x, whose box is turned by so much about its middle, 0.1 s after a right one.
class VelocityOfWrongHeading : public testing::Test {
 protected:
  static constexpr double kSpeed_mps = 2;
  StampedPose before_{At(0), Pose::Translation(5, 0, 1)};
  StampedPose After(double rad) const {
    return {At(0.1), Pose::Translation(5 + 0.1 * kSpeed_mps, 0, 1) * TurnedBy(rad)};
  }
  // Of the point in W, as `velocity_O` has it.
  static Eigen::Vector3d Of(const Eigen::Vector3d& p_O, const Twist& velocity_O,
                            const Pose& T_W_O) {
    return T_W_O.rotation * (velocity_O.linear + velocity_O.angular.cross(p_O));
  }
  Twist until_then_{{0, 0, 0.2}, {kSpeed_mps, 0, 0}};
};

TEST_F(VelocityOfWrongHeading, ChangesNoFasterThanVehiclesAccelerate) {
  const BodyBox side{{0, -0.9, 0}, {2, 0, 0.5}};  // all that was seen of it
  const StampedPose after = After(0.8);
  ASSERT_TRUE(TurnsTooFar(before_, after, side));
  const Twist velocity_O = VelocityOfStep(before_, after, side, until_then_);
  const Eigen::Vector3d was_mps = Of(side.center_O, until_then_, before_.T_W_O);
  EXPECT_NEAR((Of(side.center_O, velocity_O, after.T_W_O) - was_mps).norm(), 10 * 0.1, 1e-9);
  EXPECT_TRUE(velocity_O.angular.isApprox(until_then_.angular));
}

// A car that brakes by less stops as fast as its box does.
TEST_F(VelocityOfWrongHeading, IsThatOfThePointWhereItChangesLess) {
  const StampedPose after = After(1.5);
  const Twist until_then{Eigen::Vector3d::Zero(), {kSpeed_mps + 0.9, 0, 0}};
  const Eigen::Vector3d middle_O = Eigen::Vector3d::Zero();
  const Twist velocity_O = VelocityOfStep(before_, after, BodyBox{}, until_then);
  EXPECT_TRUE(
      Of(middle_O, velocity_O, after.T_W_O).isApprox(Eigen::Vector3d(kSpeed_mps, 0, 0), 1e-9));
}

TEST_F(VelocityOfWrongHeading, IsThatOfThePointWhereNoneIsKnownBefore) {
  const StampedPose after = After(1.5);
  const Twist velocity_O = VelocityOfStep(before_, after, BodyBox{});
  EXPECT_TRUE(Of(Eigen::Vector3d::Zero(), velocity_O, after.T_W_O)
                  .isApprox(Eigen::Vector3d(kSpeed_mps, 0, 0), 1e-9));
  EXPECT_TRUE(velocity_O.angular.isZero());
}

TEST_F(VelocityOfWrongHeading, PosesOfTheSameHeadingAreAlike) {
  std::vector<StampedPose> track;
  for (int k = 0; k < 8; ++k) {
    track.push_back({At(0.1 * k), Pose::Translation(5 + 0.1 * kSpeed_mps * k, 0, 1) *
                                      TurnedBy(k % 2 == 1 ? 0.8 : 0)});
  }
  const auto before = std::span(track).first(7);
  EXPECT_EQ(PoseAlike(before, track[7]), &track[5]);
  EXPECT_EQ(PoseAlike(std::span(track).first(2), track[7]), nullptr);  // is too long ago
  track[7].T_W_O = track[7].T_W_O * TurnedBy(2);
  EXPECT_EQ(PoseAlike(before, track[7]), nullptr);
}

// A car at rest: its ends would swing at 9 m/s.
TEST_F(VelocityOfWrongHeading, DoesNotMakeALongBodySpin) {
  const StampedPose after{At(0.1), before_.T_W_O * TurnedBy(0.45)};
  const BodyBox car{Eigen::Vector3d::Zero(), {2, 0.9, 0.8}}, person{{0, 0, 0}, {0.3, 0.2, 0.9}};
  EXPECT_TRUE(TurnsTooFar(before_, after, car));
  EXPECT_EQ(VelocityOfStep(before_, after, car, Twist{}), Twist{});
  const StampedPose person_after{At(0.1), before_.T_W_O * TurnedBy(0.4)};
  EXPECT_FALSE(TurnsTooFar(before_, person_after, person));
}

TEST_F(VelocityOfWrongHeading, FollowsTheHeadingWhereItTurnsLittle) {
  const StampedPose after = After(0.25);
  const Twist velocity_O = VelocityOfStep(before_, after, BodyBox{}, until_then_);
  EXPECT_NEAR(velocity_O.angular.z(), 2.5, 1e-9);
}

}  // namespace
}  // namespace clearway
