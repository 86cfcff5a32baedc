#include "scene/normalized_frame.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::At;

// A frame whose rotations are those of a quarter turn, times a length.
Frame Turned(double length) {
  constexpr double kHalf = 0.70710678118654752440;
  const Eigen::Quaterniond quarter(length * kHalf, 0, 0, length * kHalf);
  Frame frame = testing_support::FrameAt(1);
  frame.T_W_S = {quarter, {1.05, 2, 3.05}};
  AddPoint(frame, 0, {4.05, 0, 0});
  AddPoint(frame, 7, {2, 0, 0});
  frame.motions.push_back({7, {quarter, {0, 0, 0}}, At(0.9)});
  frame.poses.push_back({8, {quarter, {5, 0, 0}}});
  return frame;
}

TEST(Renormalized, FramesOfLengthOneStayAsTheyAre) {
  EXPECT_FALSE(Renormalized(Turned(1)).has_value());
  EXPECT_FALSE(Renormalized(Frame{}).has_value());
}

TEST(Renormalized, EveryRotationGetsLengthOne) {
  for (const double length : {0.991, 1.0001, 1.009}) {
    const Frame frame = Turned(length);
    ASSERT_TRUE(Validate(frame, {}).ok());
    const auto dut = Renormalized(frame);
    ASSERT_TRUE(dut.has_value());
    EXPECT_NEAR(dut->T_W_S.rotation.norm(), 1, 1e-15);
    EXPECT_NEAR(dut->motions[0].H_W.rotation.norm(), 1, 1e-15);
    EXPECT_NEAR(dut->poses[0].T_W_B.rotation.norm(), 1, 1e-15);
    EXPECT_EQ(dut->T_W_S.translation, frame.T_W_S.translation);
    EXPECT_EQ(dut->points_S, frame.points_S);
  }
}

TEST(Renormalized, ARoundedRotationPlacesPointsAsTheExactOne) {
  ThreadPool pool(1);
  const auto status_at = [&](const Frame& frame, const Eigen::Vector3d& p_W) {
    SceneBuilder builder(SceneParams{}, FrameLimits{}, pool);
    EXPECT_TRUE(builder.Apply(frame).ok());
    const VoxelMap& map = builder.Publish()->static_map_W;
    return map.State(map.grid().KeyOf(p_W));
  };
  // A quarter turn to the left, then to (1.05, 2, 3.05).
  EXPECT_EQ(status_at(Turned(1), {1.05, 6.05, 3.05}), VoxelState::kOccupied);
  EXPECT_EQ(status_at(Turned(1.009), {1.05, 6.05, 3.05}), VoxelState::kOccupied);
}

}  // namespace
}  // namespace clearway
