#include "wire/frame_wire.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "support/frames.h"
#include "wire/status.h"

namespace clearway {
namespace {

using testing_support::RandomFrames;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A frame that has everything.
Frame FullFrame() {
  Frame frame = testing_support::FrameAt(3);
  frame.T_W_S = {Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), {1, 2, 3}};
  testing_support::AddPoint(frame, kStaticLabel, {1, 2, 3});
  testing_support::AddPoint(frame, kIgnoreLabel, {4, 5, 6});
  testing_support::AddPoint(frame, 7, {7, 8, 9});
  frame.no_return = {0, 1, 0};
  frame.origins_S = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  frame.motions = {{7, Pose::Translation(0.1, 0, 0), frame.stamp - FromSeconds(0.1)}};
  frame.poses = {{8, Pose::Translation(5, 0, 0)}};
  frame.parts = {{7, 8}, {9, kStaticLabel}};
  return frame;
}

v1::Frame FullProto() {
  v1::Frame proto;
  Write(FullFrame(), &proto);
  return proto;
}

void ExpectEqual(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.sensor_id, b.sensor_id);
  EXPECT_EQ(a.sensor_run, b.sensor_run);
  EXPECT_EQ(a.sequence, b.sequence);
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.T_W_S, b.T_W_S);
  EXPECT_EQ(a.points_S, b.points_S);
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.no_return, b.no_return);
  EXPECT_EQ(a.origins_S, b.origins_S);
  ASSERT_EQ(a.motions.size(), b.motions.size());
  for (std::size_t i = 0; i < a.motions.size(); ++i) {
    EXPECT_EQ(a.motions[i].id, b.motions[i].id);
    EXPECT_EQ(a.motions[i].H_W, b.motions[i].H_W);
    EXPECT_EQ(a.motions[i].from, b.motions[i].from);
  }
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].id, b.poses[i].id);
    EXPECT_EQ(a.poses[i].T_W_B, b.poses[i].T_W_B);
  }
  EXPECT_EQ(a.parts, b.parts);
}

TEST(FrameWire, Empty) {
  const auto dut = ReadFrame("frame", v1::Frame(), FrameLimits{});
  EXPECT_TRUE(absl::IsInvalidArgument(dut.status()));
  EXPECT_EQ(FieldOf(dut.status()), "frame.sensor_id");
}

TEST(FrameWire, ComesBackBitForBit) {
  const auto dut = ReadFrame("frame", FullProto(), FrameLimits{});
  ASSERT_TRUE(dut.ok()) << dut.status();
  ExpectEqual(*dut, FullFrame());
}

TEST(FrameWire, RandomFramesComeBackThroughBytes) {
  RandomFrames frames(5);
  for (int i = 0; i < 50; ++i) {
    const Frame frame = frames.Next();
    v1::Frame proto, parsed;
    Write(frame, &proto);
    ASSERT_TRUE(parsed.ParseFromString(proto.SerializeAsString()));
    const auto dut = ReadFrame("frame", parsed, FrameLimits{});
    ASSERT_TRUE(dut.ok()) << dut.status();
    ExpectEqual(*dut, frame);
  }
}

TEST(FrameWire, PointsThatAreNotFiniteAreNoError) {
  v1::Frame proto = FullProto();
  proto.set_points_m(0, std::numeric_limits<float>::quiet_NaN());
  proto.set_points_m(4, std::numeric_limits<float>::infinity());
  EXPECT_TRUE(ReadFrame("frame", proto, FrameLimits{}).ok());
}

struct Refusal {
  const char* what;
  std::function<void(v1::Frame&)> spoil;
  absl::StatusCode code;
  const char* field;
};

const Refusal kRefusals[] = {
    {"no sensor", [](auto& f) { f.clear_sensor_id(); }, absl::StatusCode::kInvalidArgument,
     "frame.sensor_id"},
    {"long sensor", [](auto& f) { f.set_sensor_id(std::string(129, 'x')); },
     absl::StatusCode::kResourceExhausted, "frame.sensor_id"},
    {"no sequence", [](auto& f) { f.clear_sequence(); }, absl::StatusCode::kInvalidArgument,
     "frame.sequence"},
    {"no stamp", [](auto& f) { f.clear_stamp_ns(); }, absl::StatusCode::kInvalidArgument,
     "frame.stamp_ns"},
    {"absurd stamp", [](auto& f) { f.set_stamp_ns(std::numeric_limits<std::int64_t>::min()); },
     absl::StatusCode::kInvalidArgument, "frame.stamp_ns"},
    {"no pose", [](auto& f) { f.clear_world_from_sensor(); }, absl::StatusCode::kInvalidArgument,
     "frame.world_from_sensor"},
    {"no rotation", [](auto& f) { f.mutable_world_from_sensor()->clear_rotation(); },
     absl::StatusCode::kInvalidArgument, "frame.world_from_sensor.rotation"},
    {"no translation", [](auto& f) { f.mutable_world_from_sensor()->clear_translation_m(); },
     absl::StatusCode::kInvalidArgument, "frame.world_from_sensor.translation_m"},
    {"zero rotation",
     [](auto& f) { *f.mutable_world_from_sensor()->mutable_rotation() = v1::Quaternion(); },
     absl::StatusCode::kInvalidArgument, "frame.world_from_sensor.rotation"},
    {"long rotation",
     [](auto& f) { f.mutable_world_from_sensor()->mutable_rotation()->set_w(1.1); },
     absl::StatusCode::kInvalidArgument, "frame.world_from_sensor.rotation"},
    {"NaN pose", [](auto& f) { f.mutable_world_from_sensor()->mutable_rotation()->set_x(kNan); },
     absl::StatusCode::kInvalidArgument, "frame.world_from_sensor"},
    {"infinite pose",
     [](auto& f) { f.mutable_world_from_sensor()->mutable_translation_m()->set_x(kInfinity); },
     absl::StatusCode::kInvalidArgument, "frame.world_from_sensor"},
    {"far pose",
     [](auto& f) { f.mutable_world_from_sensor()->mutable_translation_m()->set_x(2e5); },
     absl::StatusCode::kInvalidArgument, "frame.world_from_sensor.translation_m"},
    {"broken triple", [](auto& f) { f.add_points_m(1); }, absl::StatusCode::kInvalidArgument,
     "frame.points_m"},
    {"too few labels", [](auto& f) { f.mutable_labels()->RemoveLast(); },
     absl::StatusCode::kInvalidArgument, "frame.labels"},
    {"label below -1", [](auto& f) { f.set_labels(1, -2); }, absl::StatusCode::kInvalidArgument,
     "frame.labels[1]"},
    {"too few returns", [](auto& f) { f.set_no_return("x"); }, absl::StatusCode::kInvalidArgument,
     "frame.no_return"},
    {"too few origins", [](auto& f) { f.mutable_origins_m()->Truncate(3); },
     absl::StatusCode::kInvalidArgument, "frame.origins_m"},
    {"object 0", [](auto& f) { f.mutable_motions(0)->set_object_id(0); },
     absl::StatusCode::kInvalidArgument, "frame.motions[0].object_id"},
    {"object twice", [](auto& f) { f.mutable_poses(0)->set_object_id(7); },
     absl::StatusCode::kInvalidArgument, "frame.poses[0].object_id"},
    {"no motion", [](auto& f) { f.mutable_motions(0)->clear_world_motion(); },
     absl::StatusCode::kInvalidArgument, "frame.motions[0].world_motion"},
    {"no start", [](auto& f) { f.mutable_motions(0)->clear_from_stamp_ns(); },
     absl::StatusCode::kInvalidArgument, "frame.motions[0].from_stamp_ns"},
    {"late start", [](auto& f) { f.mutable_motions(0)->set_from_stamp_ns(f.stamp_ns()); },
     absl::StatusCode::kInvalidArgument, "frame.motions[0].from_stamp_ns"},
    {"no box pose", [](auto& f) { f.mutable_poses(0)->clear_world_from_box(); },
     absl::StatusCode::kInvalidArgument, "frame.poses[0].world_from_box"},
};

TEST(FrameWire, RefusesNamingTheField) {
  for (const Refusal& refusal : kRefusals) {
    v1::Frame proto = FullProto();
    refusal.spoil(proto);
    const absl::Status dut = ReadFrame("frame", proto, FrameLimits{}).status();
    EXPECT_EQ(dut.code(), refusal.code) << refusal.what << ": " << dut;
    EXPECT_EQ(FieldOf(dut), refusal.field) << refusal.what << ": " << dut;
  }
}

TEST(FrameWire, RefusesMoreThanTheLimits) {
  FrameLimits limits;
  limits.max_points = 2;
  const absl::Status points = ReadFrame("frame", FullProto(), limits).status();
  EXPECT_TRUE(absl::IsResourceExhausted(points)) << points;
  EXPECT_EQ(FieldOf(points), "frame.points_m");
  limits = {};
  limits.max_objects = 1;
  const absl::Status objects = ReadFrame("frame", FullProto(), limits).status();
  EXPECT_TRUE(absl::IsResourceExhausted(objects)) << objects;
}

TEST(FrameWire, AcksComeBack) {
  PushAck ack;
  ack.version = 9;
  ack.stamp = TimeFromNanoseconds(77);
  ack.reached = AckLevel::kApplied;
  const Pose T_W_S{Eigen::Quaterniond(0.6, 0, 0, 0.8), {1, 2, 3}};
  ack.report = {.points_used = 1,
                .points_ignored = 2,
                .points_not_finite = 3,
                .points_self = 4,
                .points_out_of_bounds = 5,
                .motions_ignored = 6,
                .motions_implausible = 13,
                .motions_conflicting = 14,
                .objects_created = 7,
                .objects_dropped = 8,
                .objects_bridged = 15,
                .objects_estimated = 16,
                .objects_restarted = 17,
                .objects_reidentified = 10,
                .points_given = 9,
                .points_doubted = 11,
                .voxels_dynamic = 12,
                .issues = {{ObjectIssueKind::kRestarted, 5, 3.0, 0.4},
                           {ObjectIssueKind::kTurnTooLarge, 7, 3.1, 2.8}},
                .T_W_S = T_W_S};
  ack.repeated_answer = true;
  v1::PushFrameResponse proto;
  Write(ack, &proto);
  const PushAck dut = ReadPushAck(proto);
  EXPECT_EQ(dut.version, 9u);
  EXPECT_EQ(dut.stamp, ack.stamp);
  EXPECT_EQ(dut.reached, AckLevel::kApplied);
  EXPECT_TRUE(dut.repeated_answer);
  EXPECT_EQ(dut.report.points_used, 1u);
  EXPECT_EQ(dut.report.points_ignored, 2u);
  EXPECT_EQ(dut.report.points_not_finite, 3u);
  EXPECT_EQ(dut.report.points_self, 4u);
  EXPECT_EQ(dut.report.points_out_of_bounds, 5u);
  EXPECT_EQ(dut.report.motions_ignored, 6u);
  EXPECT_EQ(dut.report.objects_created, 7u);
  EXPECT_EQ(dut.report.objects_dropped, 8u);
  EXPECT_EQ(dut.report.points_given, 9u);
  EXPECT_EQ(dut.report.objects_reidentified, 10u);
  EXPECT_EQ(dut.report.points_doubted, 11u);
  EXPECT_EQ(dut.report.voxels_dynamic, 12u);
  EXPECT_EQ(dut.report.motions_implausible, 13u);
  EXPECT_EQ(dut.report.motions_conflicting, 14u);
  EXPECT_EQ(dut.report.objects_bridged, 15u);
  EXPECT_EQ(dut.report.objects_estimated, 16u);
  EXPECT_EQ(dut.report.objects_restarted, 17u);
  EXPECT_EQ(dut.report.issues, ack.report.issues);
  EXPECT_EQ(dut.report.T_W_S, T_W_S);
}

TEST(FrameWire, IssuesOfANewerServerAreLeftOut) {
  v1::PushFrameResponse proto;
  proto.set_reached(v1::ACK_LEVEL_APPLIED);
  proto.mutable_report()->add_issues()->set_kind(static_cast<v1::ObjectIssueKind>(99));
  proto.mutable_report()->add_issues();
  EXPECT_TRUE(ReadPushAck(proto).report.issues.empty());
}

TEST(FrameWire, PlaceOfSensorIsLeftOutByOlderServersAndNoneIsMadeUp) {
  v1::PushFrameResponse proto;
  proto.set_reached(v1::ACK_LEVEL_APPLIED);
  proto.mutable_report()->set_points_used(5);
  EXPECT_FALSE(ReadPushAck(proto).report.T_W_S.has_value());
  proto.mutable_report()->mutable_world_from_sensor()->mutable_translation_m()->set_x(1);
  EXPECT_FALSE(ReadPushAck(proto).report.T_W_S.has_value()) << "a pose without a rotation";
}

TEST(FrameWire, LevelsComeBackAndUnknownOnesDoNot) {
  for (AckLevel level : {AckLevel::kAccepted, AckLevel::kApplied, AckLevel::kDurable}) {
    EXPECT_EQ(*ReadAckLevel("wait_for", ToProto(level)), level);
  }
  EXPECT_EQ(*ReadAckLevel("wait_for", v1::ACK_LEVEL_UNSPECIFIED), AckLevel::kApplied);
  EXPECT_EQ(FieldOf(ReadAckLevel("wait_for", 99).status()), "wait_for");
}

}  // namespace
}  // namespace clearway
