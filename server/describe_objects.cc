#include "server/describe_objects.h"

#include <algorithm>
#include <vector>

namespace clearway {
namespace {

// But for its parts.
ObjectInfo DescribeAlone(const MovingObject& object) {
  ObjectInfo info;
  info.id = object.id;
  info.also = object.also;
  info.part_of = object.part_of;
  info.T_W_O = object.history.back().T_W_O;
  info.t_k = object.t_k();
  info.velocity_O = object.velocity_O;
  info.speed_mps = object.SpeedMps();
  if (!(object.bound == PositionBound{})) info.bound = object.bound;
  info.box_O = object.solid->box_O;
  info.box_W = Transformed(info.T_W_O, info.box_O);
  info.extent = ExtentOf(object);
  info.observed_voxels = object.map_O.observed_count();
  info.occupied_voxels = object.map_O.occupied_count();
  info.first_seen = object.first_seen;
  info.last_seen = object.last_seen;
  info.frames_seen = object.frames_seen;
  info.at_rest = object.AtRest();
  info.bridged = object.bridged;
  info.pose_source = object.pose_source();
  info.given = object.given();
  if (!object.future.empty()) info.future_end = object.future.back().stamp;
  return info;
}

}  // namespace

ObjectInfo DescribeObject(const SceneSnapshot& scene, const MovingObject& object) {
  ObjectInfo info = DescribeAlone(object);
  std::vector<PlacedPart> placed;
  for (const MovingObject* part : scene.PartsOf(object.id)) {
    info.parts.push_back(DescribeAlone(*part));
    info.last_seen = std::max(info.last_seen, part->last_seen);
    const Pose T_W_P = PredictPose(*part, object.t_k(), scene.params.horizon).T_W_O;
    placed.push_back({part, Inverse(info.T_W_O) * T_W_P});
    info.box_O.Extend(Transformed(placed.back().T_O_P, part->solid->box_O));
    info.box_W.Extend(Transformed(T_W_P, part->solid->box_O));
  }
  if (!placed.empty()) info.extent = ExtentOf(object, placed);
  return info;
}

absl::StatusOr<ObjectList> DescribeObjects(const SceneSnapshot& scene, const Gone& gone) {
  ObjectList list{{scene.version, scene.stamp}, {}};
  for (const auto& object : scene.objects) {
    if (gone()) return absl::CancelledError("the client has gone");
    const bool is_listed_with_its_whole =
        object->part_of != kStaticLabel && scene.FindObject(object->part_of) != nullptr;
    if (!is_listed_with_its_whole) list.objects.push_back(DescribeObject(scene, *object));
  }
  return list;
}

}  // namespace clearway
