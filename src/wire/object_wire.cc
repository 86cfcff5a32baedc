#include "wire/object_wire.h"

#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "wire/robot_wire.h"
#include "wire/scene_wire.h"

namespace clearway {
namespace {

void WriteExtent(const ObjectExtent& extent, v1::UprightBox* proto) {
  Write(extent.size_m, proto->mutable_size_m());
  Write(extent.center_O, proto->mutable_center_m());
  proto->set_yaw_rad(extent.yaw_rad);
}

ObjectExtent ReadExtent(FieldReader& read, const v1::UprightBox& proto) {
  return {read.Finite("extent_object.yaw_rad", proto.yaw_rad()),
          read.Vector("extent_object.size_m", proto.has_size_m(), proto.size_m()),
          read.Vector("extent_object.center_m", proto.has_center_m(), proto.center_m())};
}

}  // namespace

void Write(const ObjectInfo& object, v1::ObjectInfo* proto) {
  proto->set_object_id(object.id);
  proto->mutable_other_ids()->Add(object.also.begin(), object.also.end());
  Write(object.T_W_O, proto->mutable_world_from_object());
  proto->set_pose_stamp_ns(ToNanoseconds(object.t_k));
  if (object.velocity_O) Write(*object.velocity_O, proto->mutable_velocity_object());
  proto->set_speed_mps(object.speed_mps);
  if (object.bound) Write(*object.bound, proto->mutable_bound());
  if (!object.box_O.Empty()) Write(object.box_O, proto->mutable_box_object());
  if (!object.box_W.Empty()) Write(object.box_W, proto->mutable_box_world());
  proto->set_observed_voxels(object.observed_voxels);
  proto->set_occupied_voxels(object.occupied_voxels);
  proto->set_first_seen_ns(ToNanoseconds(object.first_seen));
  proto->set_last_seen_ns(ToNanoseconds(object.last_seen));
  proto->set_frames_seen(object.frames_seen);
  proto->set_at_rest(object.at_rest);
  proto->set_bridged(object.bridged);
  proto->set_pose_source(static_cast<v1::PoseSource>(static_cast<int>(object.pose_source) + 1));
  if (!object.box_O.Empty()) WriteExtent(object.extent, proto->mutable_extent_object());
  proto->set_given(object.given);
  if (object.future_end) proto->set_future_end_ns(ToNanoseconds(*object.future_end));
  proto->set_part_of_id(object.part_of);
  for (const ObjectInfo& part : object.parts) Write(part, proto->add_parts());
}

namespace {

PoseSource ReadPoseSource(v1::PoseSource proto) {
  switch (proto) {
    case v1::POSE_SOURCE_REPORTED:
      return PoseSource::kReported;
    case v1::POSE_SOURCE_ESTIMATED:
      return PoseSource::kEstimated;
    case v1::POSE_SOURCE_BRIDGED:
      return PoseSource::kBridged;
    default:
      return PoseSource::kFirstSight;
  }
}

// But for its parts.
ObjectInfo ReadAlone(const v1::ObjectInfo& proto, FieldReader& read) {
  ObjectInfo object;
  object.id = proto.object_id();
  object.also.assign(proto.other_ids().begin(), proto.other_ids().end());
  object.T_W_O =
      read.ReadPose("world_from_object", proto.has_world_from_object(), proto.world_from_object());
  object.t_k = TimeFromNanoseconds(proto.pose_stamp_ns());
  if (proto.has_velocity_object()) {
    object.velocity_O = read.ReadTwist("velocity_object", proto.velocity_object());
  }
  object.speed_mps = proto.speed_mps();
  if (proto.has_bound()) object.bound = read.ReadBound("bound", proto.bound());
  if (proto.has_box_object()) object.box_O = read.Box("box_object", true, proto.box_object());
  if (proto.has_box_world()) object.box_W = read.Box("box_world", true, proto.box_world());
  object.observed_voxels = proto.observed_voxels();
  object.occupied_voxels = proto.occupied_voxels();
  object.first_seen = TimeFromNanoseconds(proto.first_seen_ns());
  object.last_seen = TimeFromNanoseconds(proto.last_seen_ns());
  object.frames_seen = proto.frames_seen();
  object.at_rest = proto.at_rest();
  object.bridged = proto.bridged();
  object.pose_source = ReadPoseSource(proto.pose_source());
  if (proto.has_extent_object()) object.extent = ReadExtent(read, proto.extent_object());
  object.given = proto.given();
  if (proto.has_future_end_ns()) object.future_end = TimeFromNanoseconds(proto.future_end_ns());
  object.part_of = proto.part_of_id();
  return object;
}

}  // namespace

absl::StatusOr<ObjectInfo> ReadObject(const v1::ObjectInfo& proto) {
  FieldReader read;
  ObjectInfo object = ReadAlone(proto, read);
  for (const v1::ObjectInfo& part : proto.parts()) object.parts.push_back(ReadAlone(part, read));
  if (!read.ok()) return read.status();
  return object;
}

void Write(const PredictedPoses& poses, v1::PredictPosesResponse* proto) {
  Write(static_cast<const Versioned&>(poses), proto->mutable_scene());
  proto->mutable_object_ids()->Add(poses.objects.begin(), poses.objects.end());
  for (const PredictedPose& pose : poses.poses) {
    Append(pose.T_W_O, proto->mutable_world_from_object());
    proto->add_beyond_horizon_radius_m(
        pose.beyond_horizon_radius_m.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
}

absl::StatusOr<PredictedPoses> ReadPredictedPoses(const v1::PredictPosesResponse& proto,
                                                  std::size_t times) {
  const std::size_t count = proto.object_ids_size() * times;
  FieldReader read;
  const std::vector<Pose> poses = read.Poses("world_from_object", proto.world_from_object(), count);
  read.Require(static_cast<std::size_t>(proto.beyond_horizon_radius_m_size()) == count,
               "beyond_horizon_radius_m", "does not have one entry per pose");
  if (!read.ok()) return read.status();
  PredictedPoses answer;
  static_cast<Versioned&>(answer) = ReadVersion(proto.scene());
  answer.objects.assign(proto.object_ids().begin(), proto.object_ids().end());
  for (std::size_t i = 0; i < count; ++i) {
    const double radius_m = proto.beyond_horizon_radius_m(i);
    answer.poses.push_back({poses[i], {}});
    if (!std::isnan(radius_m)) answer.poses.back().beyond_horizon_radius_m = radius_m;
  }
  return answer;
}

void Write(const GivenObject& object, v1::GivenObject* proto) {
  proto->set_object_id(object.id);
  Write(object.shape, proto->mutable_shape());
  Write(object.pose.T_W_O, proto->mutable_world_from_object());
  proto->set_stamp_ns(ToNanoseconds(object.pose.stamp));
  if (object.velocity_O) Write(*object.velocity_O, proto->mutable_velocity_object());
  if (!object.future.empty()) Write(object.future, proto->mutable_future());
}

void Write(const ObjectFuture& future, v1::ObjectFuture* proto) {
  proto->set_object_id(future.id);
  Write(future.poses, proto->mutable_future());
}

absl::StatusOr<std::vector<GivenObject>> ReadGivenObjects(const v1::AddObjectsRequest& proto,
                                                          const ServerLimits& limits) {
  FieldReader read;
  read.AtMost("objects", proto.objects_size(), limits.max_objects);
  std::vector<GivenObject> objects;
  for (int i = 0; i < proto.objects_size() && read.ok(); ++i) {
    const v1::GivenObject& from = proto.objects(i);
    const std::string field = absl::StrCat("objects[", i, "].");
    GivenObject& object = objects.emplace_back();
    object.id = from.object_id();
    object.shape = ReadConvexShape(field + "shape", from.shape(), read);
    object.pose.T_W_O = read.ReadPose(field + "world_from_object", from.has_world_from_object(),
                                      from.world_from_object());
    object.pose.stamp = read.Stamp(field + "stamp_ns", from.has_stamp_ns(), from.stamp_ns());
    if (from.has_velocity_object()) {
      object.velocity_O = read.ReadTwist(field + "velocity_object", from.velocity_object());
    }
    object.future = read.ReadTimedPoses(field + "future", from.future(), kMaxFuturePoses);
  }
  if (!read.ok()) return read.status();
  return objects;
}

absl::StatusOr<std::vector<ObjectFuture>> ReadFutures(const v1::SetFuturesRequest& proto,
                                                      const ServerLimits& limits) {
  FieldReader read;
  read.AtMost("futures", proto.futures_size(), limits.max_objects);
  std::vector<ObjectFuture> futures;
  for (int i = 0; i < proto.futures_size() && read.ok(); ++i) {
    const std::string field = absl::StrCat("futures[", i, "].future");
    futures.push_back({proto.futures(i).object_id(),
                       read.ReadTimedPoses(field, proto.futures(i).future(), kMaxFuturePoses)});
  }
  if (!read.ok()) return read.status();
  return futures;
}

}  // namespace clearway
