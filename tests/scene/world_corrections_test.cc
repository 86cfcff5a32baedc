#include "clearway/scene/world_corrections.h"

#include <gtest/gtest.h>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::At;
using testing_support::FrameAt;
using testing_support::Random;

double Apart(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm() + a.rotation.angularDistance(b.rotation);
}

TEST(WorldCorrections, Empty) {
  const WorldCorrections dut;
  EXPECT_TRUE(dut.Empty());
  EXPECT_EQ(dut.At(At(3)), Pose{});
}

TEST(WorldCorrections, HoldAtTheirStampsAndBetween) {
  WorldCorrections dut;
  dut.Add(At(1), Pose::Translation(1, 0, 0));
  dut.Add(At(2), Pose::Translation(3, 0, 0));
  EXPECT_EQ(dut.NewestStamp(), At(2));
  EXPECT_EQ(dut.At(At(0)), Pose::Translation(1, 0, 0));
  EXPECT_EQ(dut.At(At(1)), Pose::Translation(1, 0, 0));
  EXPECT_LT(Apart(dut.At(At(1.25)), Pose::Translation(1.5, 0, 0)), 1e-12);
  EXPECT_EQ(dut.At(At(2)), Pose::Translation(3, 0, 0));
  EXPECT_EQ(dut.At(At(7)), Pose::Translation(3, 0, 0));
}

TEST(WorldCorrections, AnotherOfTheSameStampCountsInstead) {
  WorldCorrections dut;
  dut.Add(At(1), Pose::Translation(1, 0, 0));
  dut.Add(At(1), Pose::Translation(2, 0, 0));
  EXPECT_EQ(dut.At(At(1)), Pose::Translation(2, 0, 0));
}

TEST(WorldCorrections, OldOnesAreForgotten) {
  WorldCorrections dut(std::chrono::seconds(2));
  for (int k = 0; k < 6; ++k) dut.Add(At(k), Pose::Translation(k, 0, 0));
  EXPECT_EQ(dut.At(At(0)), Pose::Translation(3, 0, 0));
  EXPECT_EQ(dut.At(At(3)), Pose::Translation(3, 0, 0));
  dut.Add(At(100), Pose{});
  EXPECT_EQ(dut.At(At(3)), Pose::Translation(5, 0, 0));  // the last one before the gap
  dut.Add(At(103), Pose{});
  EXPECT_EQ(dut.At(At(3)), Pose{});
}

TEST(WorldCorrections, CarryWhatAFrameStates) {
  Random random(5);
  const Pose T_W_V0 = random.AnyPose(3), T_W_V1 = random.AnyPose(3);  // at 0 and 1 s
  WorldCorrections corrections;
  corrections.Add(At(0), T_W_V0);
  corrections.Add(At(1), T_W_V1);
  Frame frame = FrameAt(1);
  frame.T_W_S = random.AnyPose(9);
  AddPoint(frame, 3, {1, 2, 3});
  const Pose T_V_B = random.AnyPose(9), T_V0_O = random.AnyPose(9), T_V1_O = random.AnyPose(9);
  frame.poses = {{3, T_V_B}};
  frame.motions = {{4, T_V1_O * Inverse(T_V0_O), At(0)}};
  frame.parts = {{4, 3}};

  const Frame dut = CarriedBy(corrections, frame);
  EXPECT_LT(Apart(dut.T_W_S, T_W_V1 * frame.T_W_S), 1e-12);
  EXPECT_LT(Apart(dut.poses[0].T_W_B, T_W_V1 * T_V_B), 1e-12);
  EXPECT_LT(Apart(dut.motions[0].H_W * (T_W_V0 * T_V0_O), T_W_V1 * T_V1_O), 1e-9);
  EXPECT_EQ(dut.motions[0].from, At(0));
  EXPECT_EQ(dut.points_S, frame.points_S);
  EXPECT_EQ(dut.labels, frame.labels);
  EXPECT_EQ(dut.parts, frame.parts);
}

TEST(WorldCorrections, CarryNothingWhereTheWorldsAreOne) {
  Random random(6);
  Frame frame = FrameAt(1);
  frame.T_W_S = random.AnyPose(9);
  frame.poses = {{3, random.AnyPose(9)}};
  frame.motions = {{4, random.AnyPose(9), At(0)}};
  WorldCorrections none, same;
  same.Add(At(0), {});
  same.Add(At(1), {});
  for (const WorldCorrections& corrections : {none, same}) {
    const Frame dut = CarriedBy(corrections, frame);
    EXPECT_EQ(dut.T_W_S, frame.T_W_S);
    EXPECT_EQ(dut.poses[0].T_W_B, frame.poses[0].T_W_B);
    EXPECT_EQ(dut.motions[0].H_W, frame.motions[0].H_W);
  }
}

}  // namespace
}  // namespace clearway
