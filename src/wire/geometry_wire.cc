#include "wire/geometry_wire.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/unit_quaternion.h"
#include "clearway/scene/frame.h"
#include "wire/status.h"

namespace clearway {
namespace {

// Any finite position may be asked about; where limits matter, whoever uses the pose has its own.
constexpr double kAnyCoordinate_m = std::numeric_limits<double>::max();

bool BeyondLimit(std::int64_t ns) { return ns > kFarthest_ns || ns < -kFarthest_ns; }

Eigen::Vector3d ToVector(const v1::Vector3& proto) { return {proto.x(), proto.y(), proto.z()}; }

}  // namespace

void Write(const Eigen::Vector3d& vector, v1::Vector3* proto) {
  proto->set_x(vector.x());
  proto->set_y(vector.y());
  proto->set_z(vector.z());
}

void Write(const Pose& pose, v1::Pose* proto) {
  proto->mutable_rotation()->set_x(pose.rotation.x());
  proto->mutable_rotation()->set_y(pose.rotation.y());
  proto->mutable_rotation()->set_z(pose.rotation.z());
  proto->mutable_rotation()->set_w(pose.rotation.w());
  Write(pose.translation, proto->mutable_translation_m());
}

void Write(const Twist& twist, v1::Twist* proto) {
  Write(twist.angular, proto->mutable_angular_radps());
  Write(twist.linear, proto->mutable_linear_mps());
}

void Write(const PositionBound& bound, v1::PositionBound* proto) {
  proto->set_at_m(bound.at_m);
  proto->set_speed_mps(bound.speed_mps);
  proto->set_accel_mps2(bound.accel_mps2);
}

void Write(const Aabb& box, v1::AxisAlignedBox* proto) {
  Write(box.min, proto->mutable_min_m());
  Write(box.max, proto->mutable_max_m());
}

void Append(const Pose& pose, v1::PoseArray* proto) {
  for (int i = 0; i < 4; ++i) proto->add_rotations_xyzw(pose.rotation.coeffs()[i]);
  for (int i = 0; i < 3; ++i) proto->add_translations_m(pose.translation[i]);
}

void Write(std::span<const StampedPose> poses, v1::TimedPoses* proto) {
  for (const StampedPose& pose : poses) {
    proto->add_stamps_ns(ToNanoseconds(pose.stamp));
    Append(pose.T_W_O, proto->mutable_world_from_object());
  }
}

void FieldReader::Fail(const std::string& field, const std::string& what) {
  if (ok()) status_ = FieldError(path_ + field, what);
}

void FieldReader::Fail(const absl::Status& status) {
  if (ok()) status_ = WithFieldPrefix(path_, status);
}

void FieldReader::AtMost(const std::string& field, std::uint64_t size, std::uint64_t limit) {
  if (ok() && size > limit) status_ = LimitError(path_ + field, size, limit);
}

double FieldReader::Finite(const std::string& field, double value) {
  if (!std::isfinite(value)) Fail(field, "is not finite");
  return value;
}

double FieldReader::NotNegative(const std::string& field, double value) {
  Finite(field, value);
  if (value < 0) Fail(field, absl::StrCat("is ", NumberText(value), "; it must not be negative"));
  return value;
}

double FieldReader::Positive(const std::string& field, double value) {
  Finite(field, value);
  if (value <= 0) Fail(field, absl::StrCat("is ", NumberText(value), "; it must be above 0"));
  return value;
}

Time FieldReader::Stamp(const std::string& field, bool present, std::int64_t ns) {
  Require(present, field, "is missing");
  if (BeyondLimit(ns)) {
    Fail(field, absl::StrCat("is ", ns, "; the limit is ", kFarthest_ns, " either way"));
  }
  return TimeFromNanoseconds(ok() ? ns : 0);
}

Eigen::Vector3d FieldReader::Vector(const std::string& field, bool present,
                                    const v1::Vector3& proto) {
  Require(present, field, "is missing");
  const Eigen::Vector3d vector = ToVector(proto);
  if (!vector.allFinite()) Fail(field, "is not finite");
  return vector;
}

void FieldReader::CheckPose(const std::string& field, const Pose& pose) {
  if (!ok()) return;
  if (absl::Status status = ValidatePose(field, pose, kAnyCoordinate_m); !status.ok()) {
    Fail(status);
  }
}

Pose FieldReader::ReadPose(const std::string& field, bool present, const v1::Pose& proto) {
  Require(present, field, "is missing");
  Require(proto.has_rotation(), field + ".rotation", "is missing");
  Require(proto.has_translation_m(), field + ".translation_m", "is missing");
  Pose pose;
  const v1::Quaternion& q = proto.rotation();
  pose.rotation = Eigen::Quaterniond(q.w(), q.x(), q.y(), q.z());
  pose.translation = ToVector(proto.translation_m());
  CheckPose(field, pose);
  return ok() ? Normalized(pose) : Pose{};
}

PositionBound FieldReader::ReadBound(const std::string& field, const v1::PositionBound& proto) {
  return {NotNegative(field + ".at_m", proto.at_m()),
          NotNegative(field + ".speed_mps", proto.speed_mps()),
          NotNegative(field + ".accel_mps2", proto.accel_mps2())};
}

Twist FieldReader::ReadTwist(const std::string& field, const v1::Twist& proto) {
  return {Vector(field + ".angular_radps", proto.has_angular_radps(), proto.angular_radps()),
          Vector(field + ".linear_mps", proto.has_linear_mps(), proto.linear_mps())};
}

Aabb FieldReader::Box(const std::string& field, bool present, const v1::AxisAlignedBox& proto) {
  Require(present, field, "is missing");
  Aabb box;
  box.min = Vector(field + ".min_m", proto.has_min_m(), proto.min_m());
  box.max = Vector(field + ".max_m", proto.has_max_m(), proto.max_m());
  if (box.Empty()) Fail(field, "min_m must not exceed max_m on any axis");
  return box;
}

std::vector<Pose> FieldReader::Poses(const std::string& field, const v1::PoseArray& proto,
                                     std::size_t count) {
  std::vector<Pose> poses;
  const auto check = [&](const char* part, int size, std::size_t per_pose) {
    if (static_cast<std::size_t>(size) == per_pose * count) return;
    Fail(field + part,
         absl::StrCat("has ", size, " values; ", count, " poses need ", per_pose * count));
  };
  check(".rotations_xyzw", proto.rotations_xyzw_size(), 4);
  check(".translations_m", proto.translations_m_size(), 3);
  if (!ok()) return poses;
  poses.reserve(count);
  for (std::size_t i = 0; i < count && ok(); ++i) {
    const double* q = proto.rotations_xyzw().data() + 4 * i;
    const double* p = proto.translations_m().data() + 3 * i;
    const Pose pose{Eigen::Quaterniond(q[3], q[0], q[1], q[2]), {p[0], p[1], p[2]}};
    const absl::Status status = ValidatePose("", pose, kAnyCoordinate_m);
    if (!status.ok()) CheckPose(absl::StrCat(field, "[", i, "]"), pose);
    poses.push_back(Normalized(pose));
  }
  return poses;
}

std::vector<StampedPose> FieldReader::ReadTimedPoses(const std::string& field,
                                                     const v1::TimedPoses& proto,
                                                     std::uint64_t limit) {
  std::vector<StampedPose> timed;
  AtMost(field + ".stamps_ns", proto.stamps_ns_size(), limit);
  if (!ok()) return timed;
  const std::vector<Pose> poses =
      Poses(field + ".world_from_object", proto.world_from_object(), proto.stamps_ns_size());
  for (int i = 0; i < proto.stamps_ns_size() && ok(); ++i) {
    const std::string stamp_field = absl::StrCat(field, ".stamps_ns[", i, "]");
    timed.push_back({Stamp(stamp_field, true, proto.stamps_ns(i)), poses[i]});
  }
  return timed;
}

void FieldReader::CheckTimes(const std::string& field,
                             const google::protobuf::RepeatedField<std::int64_t>& times_ns,
                             std::size_t items) {
  const std::size_t size = times_ns.size();
  if (size != items && size != 1) {
    Fail(field,
         absl::StrCat("has ", size, " entries; one is needed, or one per item (", items, ")"));
  }
  const auto bad = std::find_if(times_ns.begin(), times_ns.end(), BeyondLimit);
  if (bad == times_ns.end()) return;
  Stamp(absl::StrCat(field, "[", bad - times_ns.begin(), "]"), true, *bad);
}

std::vector<Time> FieldReader::Times(const std::string& field,
                                     const google::protobuf::RepeatedField<std::int64_t>& times_ns,
                                     std::size_t items) {
  std::vector<Time> times;
  CheckTimes(field, times_ns, items);
  if (!ok()) return times;
  times.reserve(times_ns.size());
  for (std::int64_t ns : times_ns) times.push_back(TimeFromNanoseconds(ns));
  return times;
}

}  // namespace clearway
