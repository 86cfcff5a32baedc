#include "wire/frame_wire.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "wire/depth_wire.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::size_t kMaxSensorIdBytes = 128;

void WritePoints(const std::vector<Eigen::Vector3f>& points,
                 google::protobuf::RepeatedField<float>* proto) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  const float* first = points.empty() ? nullptr : points.front().data();
  proto->Add(first, first + 3 * points.size());
}

void CheckSizes(const v1::Frame& proto, const FrameLimits& limits, FieldReader& read) {
  read.Require(!proto.sensor_id().empty(), "sensor_id", "is missing");
  read.AtMost("sensor_id", proto.sensor_id().size(), kMaxSensorIdBytes);
  read.Require(proto.has_sequence(), "sequence", "is missing");
  read.AtMost("points_m", proto.points_m_size() / 3, limits.max_points);
  read.AtMost("labels", proto.labels_size(), limits.max_points);
  read.AtMost("no_return", proto.no_return().size(), limits.max_points);
  read.AtMost("origins_m", proto.origins_m_size() / 3, limits.max_points);
  read.AtMost("motions", proto.motions_size(), limits.max_objects);
  read.AtMost("poses", proto.poses_size(), limits.max_objects);
  read.AtMost("parts", proto.parts_size(), limits.max_objects);
}

void ReadMotions(const v1::Frame& proto, FieldReader& read, Frame& frame) {
  for (int i = 0; i < proto.motions_size() && read.ok(); ++i) {
    const v1::ObjectMotion& motion = proto.motions(i);
    const std::string field = absl::StrCat("motions[", i, "]");
    frame.motions.push_back(
        {motion.object_id(),
         read.ReadPose(field + ".world_motion", motion.has_world_motion(), motion.world_motion()),
         read.Stamp(field + ".from_stamp_ns", motion.has_from_stamp_ns(), motion.from_stamp_ns())});
  }
  for (int i = 0; i < proto.poses_size() && read.ok(); ++i) {
    const v1::ObjectPose& pose = proto.poses(i);
    frame.poses.push_back(
        {pose.object_id(), read.ReadPose(absl::StrCat("poses[", i, "].world_from_box"),
                                         pose.has_world_from_box(), pose.world_from_box())});
  }
}

void ReadParts(const v1::Frame& proto, FieldReader& read, Frame& frame) {
  for (int i = 0; i < proto.parts_size() && read.ok(); ++i) {
    const v1::ObjectPart& part = proto.parts(i);
    read.Require(part.has_whole_id(), absl::StrCat("parts[", i, "].whole_id"), "is missing");
    frame.parts.push_back({part.object_id(), part.whole_id()});
  }
}

// The points themselves, or the depth image that they are.
void ReadPoints(const v1::Frame& proto, const FrameLimits& limits, FieldReader& read,
                Frame& frame) {
  frame.points_S = read.Triples<float>("points_m", proto.points_m(), false);
  frame.origins_S = read.Triples<float>("origins_m", proto.origins_m(), false);
  if (!read.ok()) return;
  frame.labels.assign(proto.labels().begin(), proto.labels().end());
  frame.no_return.assign(proto.no_return().begin(), proto.no_return().end());
  if (!proto.has_depth_image()) return;
  const std::pair<const char*, bool> others[] = {{"points_m", !frame.points_S.empty()},
                                                 {"labels", !frame.labels.empty()},
                                                 {"no_return", !frame.no_return.empty()},
                                                 {"origins_m", !frame.origins_S.empty()}};
  for (const auto& [field, is_there] : others) {
    if (is_there)
      read.Fail("depth_image", absl::StrCat("there are ", field,
                                            " too; a frame has a "
                                            "depth image or points"));
  }
  if (!read.ok()) return;
  const absl::StatusOr<DepthImage> image = ReadDepthImage(proto.depth_image(), limits.max_points);
  if (!image.ok()) return read.Fail(image.status());
  SetPoints(*image, frame);
}

// What became of the objects' motions.
void WriteObjects(const FrameReport& report, v1::FrameReport* proto) {
  proto->set_motions_implausible(report.motions_implausible);
  proto->set_motions_conflicting(report.motions_conflicting);
  proto->set_objects_bridged(report.objects_bridged);
  proto->set_objects_estimated(report.objects_estimated);
  proto->set_objects_restarted(report.objects_restarted);
  for (const ObjectIssue& issue : report.issues) {
    v1::ObjectIssue* out = proto->add_issues();
    out->set_object_id(issue.id);
    out->set_kind(static_cast<v1::ObjectIssueKind>(issue.kind));
    out->set_value(issue.value);
    out->set_limit(issue.limit);
  }
}

void ReadObjects(const v1::FrameReport& proto, FrameReport& report) {
  report.motions_implausible = proto.motions_implausible();
  report.motions_conflicting = proto.motions_conflicting();
  report.objects_bridged = proto.objects_bridged();
  report.objects_estimated = proto.objects_estimated();
  report.objects_restarted = proto.objects_restarted();
  for (const v1::ObjectIssue& issue : proto.issues()) {
    const bool known = v1::ObjectIssueKind_IsValid(issue.kind()) &&
                       issue.kind() != v1::OBJECT_ISSUE_KIND_UNSPECIFIED;
    if (!known) continue;  // of a newer server
    report.issues.push_back({static_cast<ObjectIssueKind>(issue.kind()), issue.object_id(),
                             issue.value(), issue.limit()});
  }
}

}  // namespace

void Write(const Frame& frame, v1::Frame* proto) {
  proto->set_sensor_id(frame.sensor_id);
  proto->set_sensor_run(frame.sensor_run);
  proto->set_sequence(frame.sequence);
  proto->set_stamp_ns(ToNanoseconds(frame.stamp));
  Write(frame.T_W_S, proto->mutable_world_from_sensor());
  WritePoints(frame.points_S, proto->mutable_points_m());
  proto->mutable_labels()->Add(frame.labels.begin(), frame.labels.end());
  proto->set_no_return(frame.no_return.data(), frame.no_return.size());
  WritePoints(frame.origins_S, proto->mutable_origins_m());
  for (const ObjectMotion& motion : frame.motions) {
    v1::ObjectMotion* out = proto->add_motions();
    out->set_object_id(motion.id);
    Write(motion.H_W, out->mutable_world_motion());
    out->set_from_stamp_ns(ToNanoseconds(motion.from));
  }
  for (const ObjectPose& pose : frame.poses) {
    v1::ObjectPose* out = proto->add_poses();
    out->set_object_id(pose.id);
    Write(pose.T_W_B, out->mutable_world_from_box());
  }
  for (const ObjectPart& part : frame.parts) {
    v1::ObjectPart* out = proto->add_parts();
    out->set_object_id(part.id);
    out->set_whole_id(part.whole);
  }
}

void Write(const Frame& frame, const DepthImage& image, v1::Frame* proto) {
  Write(frame, proto);
  Write(image, proto->mutable_depth_image());
}

absl::StatusOr<Frame> ReadFrame(const std::string& field, const v1::Frame& proto,
                                const FrameLimits& limits) {
  FieldReader read(field + ".");
  CheckSizes(proto, limits, read);
  Frame frame;
  frame.sensor_id = proto.sensor_id();
  frame.sensor_run = proto.sensor_run();
  frame.sequence = proto.sequence();
  frame.stamp = read.Stamp("stamp_ns", proto.has_stamp_ns(), proto.stamp_ns());
  frame.T_W_S =
      read.ReadPose("world_from_sensor", proto.has_world_from_sensor(), proto.world_from_sensor());
  ReadMotions(proto, read, frame);
  ReadParts(proto, read, frame);
  ReadPoints(proto, limits, read, frame);
  if (!read.ok()) return read.status();
  if (absl::Status status = Validate(frame, limits); !status.ok()) {
    return WithFieldPrefix(field + ".", status);
  }
  return frame;
}

v1::AckLevel ToProto(AckLevel level) {
  return level == AckLevel::kAccepted  ? v1::ACK_LEVEL_ACCEPTED
         : level == AckLevel::kApplied ? v1::ACK_LEVEL_APPLIED
                                       : v1::ACK_LEVEL_DURABLE;
}

absl::StatusOr<AckLevel> ReadAckLevel(const std::string& field, int proto) {
  switch (proto) {
    case v1::ACK_LEVEL_ACCEPTED:
      return AckLevel::kAccepted;
    case v1::ACK_LEVEL_UNSPECIFIED:
    case v1::ACK_LEVEL_APPLIED:
      return AckLevel::kApplied;
    case v1::ACK_LEVEL_DURABLE:
      return AckLevel::kDurable;
    default:
      return FieldError(field, absl::StrCat("is ", proto, ", which is no known level"));
  }
}

void Write(const PushAck& ack, v1::PushFrameResponse* proto) {
  Write(static_cast<const Versioned&>(ack), proto->mutable_scene());
  proto->set_reached(ToProto(ack.reached));
  proto->set_repeated_answer(ack.repeated_answer);
  if (ack.reached == AckLevel::kAccepted) return;
  v1::FrameReport* report = proto->mutable_report();
  report->set_points_used(ack.report.points_used);
  report->set_points_ignored(ack.report.points_ignored);
  report->set_points_not_finite(ack.report.points_not_finite);
  report->set_points_self(ack.report.points_self);
  report->set_points_out_of_bounds(ack.report.points_out_of_bounds);
  report->set_motions_ignored(ack.report.motions_ignored);
  report->set_objects_created(ack.report.objects_created);
  report->set_objects_dropped(ack.report.objects_dropped);
  report->set_points_given(ack.report.points_given);
  report->set_objects_reidentified(ack.report.objects_reidentified);
  report->set_points_doubted(ack.report.points_doubted);
  report->set_voxels_dynamic(ack.report.voxels_dynamic);
  WriteObjects(ack.report, report);
  if (ack.report.T_W_S) Write(*ack.report.T_W_S, report->mutable_world_from_sensor());
  report->set_late_by_ns(ack.report.late_by.count());
}

PushAck ReadPushAck(const v1::PushFrameResponse& proto) {
  PushAck ack;
  static_cast<Versioned&>(ack) = ReadVersion(proto.scene());
  ack.reached = ReadAckLevel("reached", proto.reached()).value_or(AckLevel::kAccepted);
  ack.repeated_answer = proto.repeated_answer();
  const v1::FrameReport& report = proto.report();
  ack.report.points_used = report.points_used();
  ack.report.points_ignored = report.points_ignored();
  ack.report.points_not_finite = report.points_not_finite();
  ack.report.points_self = report.points_self();
  ack.report.points_out_of_bounds = report.points_out_of_bounds();
  ack.report.motions_ignored = report.motions_ignored();
  ack.report.objects_created = report.objects_created();
  ack.report.objects_dropped = report.objects_dropped();
  ack.report.points_given = report.points_given();
  ack.report.objects_reidentified = report.objects_reidentified();
  ack.report.points_doubted = report.points_doubted();
  ack.report.voxels_dynamic = report.voxels_dynamic();
  ack.report.late_by = Duration(report.late_by_ns());
  ReadObjects(report, ack.report);
  if (report.has_world_from_sensor()) {
    FieldReader read("report.");
    const Pose T_W_S = read.ReadPose("world_from_sensor", true, report.world_from_sensor());
    if (read.ok()) ack.report.T_W_S = T_W_S;
  }
  return ack;
}

}  // namespace clearway
