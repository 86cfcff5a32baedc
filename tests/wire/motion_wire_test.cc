#include "wire/motion_wire.h"

#include <gtest/gtest.h>

#include "support/random.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

// Three motions of 2, 3 and 2 knots of two links.
MotionBatch Motions() {
  testing_support::Random random(3);
  MotionBatch motions{{2, 3, 2}, {}, {}, {}};
  for (int k = 0; k < 7; ++k) {
    motions.times.push_back(TimeFromNanoseconds(10 + k));
    for (int l = 0; l < 2; ++l) {
      motions.T_W_L.push_back(random.AnyPose(5));
      motions.deviations_m.push_back(0.01 * k + l);
    }
  }
  return motions;
}

TEST(MotionWire, PartsOfABatchComeBack) {
  const MotionBatch motions = Motions();
  v1::CheckMotionsRequest proto;
  WriteMotions(motions, 2, 1, 3, 2, &proto);
  const auto dut = ReadMotions(proto, 2, ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->knot_counts, (std::vector<std::size_t>{3, 2}));
  EXPECT_EQ(dut->times, std::vector<Time>(motions.times.begin() + 2, motions.times.end()));
  EXPECT_EQ(dut->T_W_L, std::vector<Pose>(motions.T_W_L.begin() + 4, motions.T_W_L.end()));
  EXPECT_EQ(dut->deviations_m,
            std::vector<double>(motions.deviations_m.begin() + 4, motions.deviations_m.end()));
}

TEST(MotionWire, OptionsComeBack) {
  MotionOptions options;
  options.check.padding_m = 0.25;
  options.contact_resolution_m = 0.125;
  options.world_at = TimeFromNanoseconds(-5);
  v1::CheckMotionsRequest proto;
  Write(options, &proto);
  auto dut = ReadMotionOptions(proto, ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->check.padding_m, 0.25);
  EXPECT_EQ(dut->contact_resolution_m, 0.125);
  EXPECT_EQ(dut->world_at, options.world_at);
  proto.clear_contact_resolution_m();
  proto.clear_world_at_ns();
  dut = ReadMotionOptions(proto, ServerLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->contact_resolution_m, MotionOptions{}.contact_resolution_m);
  EXPECT_FALSE(dut->world_at.has_value());
}

TEST(MotionWire, MoreKnotsThanAllowedAreRefused) {
  v1::CheckMotionsRequest proto;
  WriteMotions(Motions(), 2, 0, 3, 0, &proto);
  ServerLimits limits;
  limits.max_states_per_batch = 6;
  const auto dut = ReadMotions(proto, 2, limits);
  EXPECT_TRUE(absl::IsResourceExhausted(dut.status()));
  EXPECT_EQ(FieldOf(dut.status()), "times_ns");
}

TEST(MotionWire, RepliesComeBack) {
  const Time from = TimeFromNanoseconds(20), until = TimeFromNanoseconds(30);
  const MotionReply reply{5,
                          TimeFromNanoseconds(6),
                          Duration(7),
                          0.25,
                          1.5,
                          {{SpaceStatus::kFree, until, std::nullopt},
                           {SpaceStatus::kUnresolved, from, std::nullopt},
                           {SpaceStatus::kOccupied, from, {{from, until, 1, 3, {{-1, 2, -3}}}}},
                           {SpaceStatus::kOutOfBounds, from, {{from, until, 0, 0, {}}}}}};
  v1::CheckMotionsResponse proto;
  Write(reply, &proto);
  const auto dut = ReadMotionReply(proto, 4);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->version, 5u);
  EXPECT_EQ(dut->stamp, reply.stamp);
  EXPECT_EQ(dut->horizon, reply.horizon);
  EXPECT_EQ(dut->inflation_mps, 0.25);
  EXPECT_EQ(dut->bound_multiple, 1.5);
  for (std::size_t m = 0; m < 4; ++m) {
    const MotionAnswer &answer = dut->answers[m], &expected = reply.answers[m];
    EXPECT_EQ(answer.status, expected.status);
    EXPECT_EQ(answer.free_until, expected.free_until);
    ASSERT_EQ(answer.witness.has_value(), expected.witness.has_value());
    if (!answer.witness) continue;
    EXPECT_EQ(answer.witness->from, from);
    EXPECT_EQ(answer.witness->until, until);
    EXPECT_EQ(answer.witness->link, expected.witness->link);
    EXPECT_EQ(answer.witness->object, expected.witness->object);
    EXPECT_EQ(answer.witness->voxel, expected.witness->voxel);
  }
}

TEST(MotionWire, AReplyOfTheWrongLengthIsNoAnswer) {
  v1::CheckMotionsResponse good;
  Write(MotionReply{1, Time{}, {}, 0, 0, {MotionAnswer{}}}, &good);
  EXPECT_TRUE(ReadMotionReply(good, 1).ok());
  EXPECT_TRUE(absl::IsInternal(ReadMotionReply(good, 2).status()));
  v1::CheckMotionsResponse bad = good;
  bad.mutable_voxels()->RemoveLast();
  EXPECT_TRUE(absl::IsInternal(ReadMotionReply(bad, 1).status()));
  bad = good;
  bad.clear_contact_ns();
  EXPECT_TRUE(absl::IsInternal(ReadMotionReply(bad, 1).status()));
  EXPECT_TRUE(absl::IsInternal(ReadMotionReply({}, 1).status()));
}

}  // namespace
}  // namespace clearway
