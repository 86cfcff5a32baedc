#include "wire/scene_wire.h"

namespace clearway {

void Write(const Versioned& scene, v1::SceneVersion* proto) {
  proto->set_version(scene.version);
  proto->set_stamp_ns(ToNanoseconds(scene.stamp));
}

Versioned ReadVersion(const v1::SceneVersion& proto) {
  return {proto.version(), TimeFromNanoseconds(proto.stamp_ns())};
}

void Write(const SceneQuery& query, v1::SceneSelector* proto) {
  if (query.min_version > 0) proto->set_min_version(query.min_version);
  proto->set_lease_id(query.lease_id);
}

SceneQuery ReadQuery(const v1::SceneSelector& proto) {
  return {proto.min_version(), proto.lease_id()};
}

namespace {

v1::SolidMode ToProto(SolidMode mode) {
  switch (mode) {
    case SolidMode::kConvexHull:
      return v1::SOLID_MODE_CONVEX_HULL;
    case SolidMode::kVoxels:
      return v1::SOLID_MODE_VOXELS;
    case SolidMode::kCompletedHull:
      return v1::SOLID_MODE_COMPLETED_HULL;
  }
  return v1::SOLID_MODE_UNSPECIFIED;
}

SolidMode ReadSolidMode(int proto, FieldReader& read) {
  switch (proto) {
    case v1::SOLID_MODE_VOXELS:
      return SolidMode::kVoxels;
    case v1::SOLID_MODE_COMPLETED_HULL:
      return SolidMode::kCompletedHull;
    default:
      read.Require(proto == v1::SOLID_MODE_CONVEX_HULL, "solid", "is not a known mode");
      return SolidMode::kConvexHull;
  }
}

v1::MotionFromPoints ToProto(MotionFromPoints value) {
  switch (value) {
    case MotionFromPoints::kAuto:
      return v1::MOTION_FROM_POINTS_AUTO;
    case MotionFromPoints::kOn:
      return v1::MOTION_FROM_POINTS_ON;
    case MotionFromPoints::kOff:
      return v1::MOTION_FROM_POINTS_OFF;
  }
  return v1::MOTION_FROM_POINTS_UNSPECIFIED;
}

MotionFromPoints ReadMotionFromPoints(int proto, FieldReader& read) {
  switch (proto) {
    case v1::MOTION_FROM_POINTS_AUTO:
      return MotionFromPoints::kAuto;
    case v1::MOTION_FROM_POINTS_ON:
      return MotionFromPoints::kOn;
    default:
      read.Require(v1::MotionFromPoints_IsValid(proto), "motion_from_points",
                   "is not a known mode");
      return MotionFromPoints::kOff;
  }
}

}  // namespace

v1::SpaceStatus ToProto(SpaceStatus status) {
  switch (status) {
    case SpaceStatus::kFree:
      return v1::SPACE_STATUS_FREE;
    case SpaceStatus::kUnknownSpace:
      return v1::SPACE_STATUS_UNKNOWN_SPACE;
    case SpaceStatus::kBeyondHorizon:
      return v1::SPACE_STATUS_BEYOND_HORIZON;
    case SpaceStatus::kOccupied:
      return v1::SPACE_STATUS_OCCUPIED;
    case SpaceStatus::kOutOfBounds:
      return v1::SPACE_STATUS_OUT_OF_BOUNDS;
    case SpaceStatus::kUnresolved:
      return v1::SPACE_STATUS_UNRESOLVED;
  }
  return v1::SPACE_STATUS_UNRESOLVED;
}

SpaceStatus ReadSpaceStatus(int proto) {
  switch (proto) {
    case v1::SPACE_STATUS_FREE:
      return SpaceStatus::kFree;
    case v1::SPACE_STATUS_UNKNOWN_SPACE:
      return SpaceStatus::kUnknownSpace;
    case v1::SPACE_STATUS_BEYOND_HORIZON:
      return SpaceStatus::kBeyondHorizon;
    case v1::SPACE_STATUS_OCCUPIED:
      return SpaceStatus::kOccupied;
    case v1::SPACE_STATUS_OUT_OF_BOUNDS:
      return SpaceStatus::kOutOfBounds;
    default:
      return SpaceStatus::kUnresolved;
  }
}

void Write(const SceneParams& params, v1::SceneParams* proto) {
  proto->set_resolution_m(params.resolution_m);
  proto->set_object_resolution_m(params.object_resolution_m);
  proto->set_probability_hit(params.occupancy.hit);
  proto->set_probability_miss(params.occupancy.miss);
  proto->set_clamp_min(params.occupancy.clamp_min);
  proto->set_clamp_max(params.occupancy.clamp_max);
  proto->set_occupied_threshold(params.occupancy.occupied);
  proto->set_max_range_m(params.rays.max_range_m);
  proto->set_discretize(params.rays.discretize);
  proto->set_grazing_m(params.rays.grazing_m);
  proto->set_octomap_ends(params.rays.octomap_ends);
  proto->set_solid(ToProto(params.solid));
  proto->set_clear_objects_by_rays(params.clear_objects_by_rays);
  proto->set_motion(params.motion == MotionModel::kTrack ? v1::MOTION_MODEL_TRACK
                                                         : v1::MOTION_MODEL_LAST_MOTION);
  proto->set_motion_from_points(ToProto(params.motion_from_points));
  proto->set_horizon_ns(params.horizon.count());
  proto->set_object_lifetime_ns(params.object_lifetime.count());
  proto->set_history_ns(params.history.count());
  proto->set_rest_distance_m(params.rest_distance_m);
  proto->set_object_pose_error_m(params.object_pose_error_m);
  proto->set_object_pose_error_rad(params.object_pose_error_rad);
  proto->set_sensor_pose_error_m(params.sensor_pose_error_m);
  proto->set_sensor_pose_error_rad(params.sensor_pose_error_rad);
  proto->set_reidentify(params.reidentify);
  proto->set_filter_labels(params.filter_labels);
  proto->set_dynamic_life_ns(params.dynamic_life.count());
  proto->set_dynamic_settle_ns(params.dynamic_settle.count());
  proto->set_keep_distance_m(params.keep_distance_m);
  Write(params.bounds_W, proto->mutable_bounds_world());
  for (const Aabb& box : params.keep_out_W) Write(box, proto->add_keep_out_world());
  for (const Aabb& box : params.self_filter_S) Write(box, proto->add_self_filter_sensor());
}

absl::StatusOr<SceneParams> ReadSceneParams(const std::string& field,
                                            const v1::SceneParams& proto) {
  FieldReader read(field + ".");
  SceneParams params;
  params.resolution_m = proto.resolution_m();
  params.object_resolution_m = proto.object_resolution_m();
  params.occupancy = {proto.probability_hit(), proto.probability_miss(), proto.clamp_min(),
                      proto.clamp_max(), proto.occupied_threshold()};
  params.rays = {proto.max_range_m(), proto.discretize(), proto.grazing_m(), proto.octomap_ends()};
  params.solid = ReadSolidMode(proto.solid(), read);
  params.clear_objects_by_rays = proto.clear_objects_by_rays();
  read.Require(v1::MotionModel_IsValid(proto.motion()), "motion", "is not a known model");
  params.motion =
      proto.motion() == v1::MOTION_MODEL_TRACK ? MotionModel::kTrack : MotionModel::kLastMotion;
  params.motion_from_points = ReadMotionFromPoints(proto.motion_from_points(), read);
  params.horizon = Duration(proto.horizon_ns());
  params.object_lifetime = Duration(proto.object_lifetime_ns());
  params.history = Duration(proto.history_ns());
  params.rest_distance_m = proto.rest_distance_m();
  params.object_pose_error_m = proto.object_pose_error_m();
  params.object_pose_error_rad = proto.object_pose_error_rad();
  params.sensor_pose_error_m = proto.sensor_pose_error_m();
  params.sensor_pose_error_rad = proto.sensor_pose_error_rad();
  params.reidentify = proto.reidentify();
  params.filter_labels = proto.filter_labels();
  params.dynamic_life = Duration(proto.dynamic_life_ns());
  params.dynamic_settle = Duration(proto.dynamic_settle_ns());
  params.keep_distance_m = proto.keep_distance_m();
  params.bounds_W = read.Box("bounds_world", proto.has_bounds_world(), proto.bounds_world());
  for (const v1::AxisAlignedBox& box : proto.keep_out_world()) {
    params.keep_out_W.push_back(read.Box("keep_out_world", true, box));
  }
  for (const v1::AxisAlignedBox& box : proto.self_filter_sensor()) {
    params.self_filter_S.push_back(read.Box("self_filter_sensor", true, box));
  }
  if (read.ok()) {
    if (absl::Status status = Validate(params); !status.ok()) read.Fail(status);
  }
  if (!read.ok()) return read.status();
  return params;
}

}  // namespace clearway
