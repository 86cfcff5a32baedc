#include "scene/object_delta.h"

#include <cmath>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "scene/given_object.h"
#include "scene/map_delta.h"

namespace clearway {
namespace {

// Whether the future is the one before without the poses up to t_k.
bool KeepsFuture(const MovingObject& from, const MovingObject& to) {
  return !to.future.empty() && to.future == FutureAfter(from.future, to.t_k());
}

absl::Status Malformed(const std::string& what) { return absl::InvalidArgumentError(what); }

absl::Status CheckPoses(const std::string& field, const std::vector<StampedPose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string entry = absl::StrCat(field, "[", i, "]");
    if (i > 0 && poses[i].stamp <= poses[i - 1].stamp) {
      return Malformed(absl::StrCat(entry, ".stamp_ns: does not ascend"));
    }
    constexpr double kAnyCoordinate_m = 1e9;
    if (auto status = ValidatePose(entry, poses[i].T_W_O, kAnyCoordinate_m); !status.ok()) {
      return status;
    }
  }
  return absl::OkStatus();
}

absl::Status CheckBound(const std::string& field, const PositionBound& bound) {
  for (const double value : {bound.at_m, bound.speed_mps, bound.accel_mps2}) {
    if (value >= 0 && value <= kMaxBoundTerm) continue;
    return Malformed(absl::StrCat(field, ".bound: ", NumberText(value),
                                  " does not lie between 0 and ", NumberText(kMaxBoundTerm)));
  }
  return absl::OkStatus();
}

absl::Status CheckCompletion(const std::string& field, const ObjectDelta& delta) {
  if (!delta.completion) return absl::OkStatus();
  const auto& [yaw_rad, unseen_end, length_seen] = *delta.completion;
  if (delta.given) return Malformed(absl::StrCat(field, ".completion: is of a given object"));
  if (!(std::abs(yaw_rad) <= 4)) {
    return Malformed(absl::StrCat(field, ".completion.yaw_rad: ", NumberText(yaw_rad),
                                  " does not lie between -4 and 4"));
  }
  if (unseen_end < -1 || unseen_end > 1) {
    return Malformed(
        absl::StrCat(field, ".completion.unseen_end: is ", unseen_end, ", not -1, 0 or 1"));
  }
  return absl::OkStatus();
}

absl::Status CheckPoses(const std::string& field, const ObjectDelta& delta) {
  if (delta.history.empty()) return Malformed(absl::StrCat(field, ".history: is empty"));
  if (auto status = CheckPoses(field + ".history", delta.history); !status.ok()) return status;
  if (!delta.future.empty() && delta.future.front().stamp <= delta.history.back().stamp) {
    return Malformed(absl::StrCat(field, ".future: does not follow the history"));
  }
  return CheckPoses(field + ".future", delta.future);
}

// The map and solid of a reconstructed object.
absl::Status ApplyVoxels(const std::string& field, const MovingObject* base,
                         const ObjectDelta& delta, const SceneParams& params,
                         MovingObject& object) {
  if (delta.given_shape != nullptr) {
    return Malformed(absl::StrCat(field, ".given_shape: is of an object that is not given"));
  }
  if (base != nullptr && delta.map_O.empty() && delta.completion == base->completion) {
    return absl::OkStatus();
  }
  VoxelMap map_O =
      base != nullptr ? base->map_O : VoxelMap(params.object_resolution_m, params.Model());
  if (auto status = ApplyMap(absl::StrCat(field, ".map"), delta.map_O, map_O); !status.ok()) {
    return status;
  }
  object = WithMap(std::move(object), std::move(map_O));
  return absl::OkStatus();
}

// The shape and solid of a given one.
absl::Status ApplyShape(const std::string& field, const MovingObject* base,
                        const ObjectDelta& delta, const SceneParams& params, MovingObject& object) {
  if (!delta.map_O.empty()) return Malformed(absl::StrCat(field, ".map: is of a given object"));
  if (delta.given_shape == nullptr) {
    return base != nullptr ? absl::OkStatus()
                           : Malformed(absl::StrCat(field, ".given_shape: is missing"));
  }
  if (auto status = ValidateGivenShape(field + ".given_shape", *delta.given_shape); !status.ok()) {
    return status;
  }
  object.map_O = VoxelMap(params.object_resolution_m, params.Model());
  object.given_shape = delta.given_shape;
  object.solid = SolidOf(*delta.given_shape);
  if (!object.solid->hull->triangles.empty()) return absl::OkStatus();
  return Malformed(absl::StrCat(field, ".given_shape: has no volume"));
}

}  // namespace

ObjectDelta DiffObjects(const MovingObject* from, const MovingObject& to, MapDetail detail) {
  const VoxelMap empty(to.map_O.grid().resolution_m(), to.map_O.model());
  if (from != nullptr && from->given() != to.given()) from = nullptr;
  ObjectDelta delta;
  delta.id = to.id;
  delta.also = to.also;
  delta.older_ids_told = to.older_ids_told;
  delta.part_of = to.part_of;
  delta.map_O = DiffMaps(from == nullptr ? empty : from->map_O, to.map_O, detail);
  delta.completion = to.completion;
  delta.history = to.history;
  delta.keeps_future = from != nullptr && KeepsFuture(*from, to);
  if (!delta.keeps_future) delta.future = to.future;
  delta.future_velocity_O = to.future_velocity_O;
  delta.given = to.given();
  const bool known_shape = from != nullptr && to.given() && *from->given_shape == *to.given_shape;
  if (!known_shape) delta.given_shape = to.given_shape;
  delta.velocity_O = to.velocity_O;
  delta.bound = to.bound;
  delta.tracked_since = to.tracked_since;
  delta.placed_at = to.placed_at;
  delta.estimated = to.estimated;
  delta.reported = to.reported;
  delta.T_B_O = to.T_B_O;
  delta.first_seen = to.first_seen;
  delta.last_seen = to.last_seen;
  delta.frames_seen = to.frames_seen;
  delta.bridged = to.bridged;
  return delta;
}

absl::StatusOr<std::shared_ptr<const MovingObject>> ApplyObject(const MovingObject* base,
                                                                const ObjectDelta& delta,
                                                                const SceneParams& params) {
  const std::string field = absl::StrCat("objects[id=", delta.id, "]");
  if (delta.id <= kStaticLabel) return Malformed(absl::StrCat(field, ": object ids start at 1"));
  for (const ObjectId id : delta.also) {
    if (id <= kStaticLabel) return Malformed(absl::StrCat(field, ".other_ids: has ", id));
  }
  if (delta.older_ids_told.size() != delta.also.size()) {
    return Malformed(absl::StrCat(field, ".older_ids_told_ns: has ", delta.older_ids_told.size(),
                                  " stamps for ", delta.also.size(), " other_ids"));
  }
  if (delta.part_of < kStaticLabel || delta.part_of == delta.id) {
    return Malformed(absl::StrCat(field, ".part_of_id: is ", delta.part_of));
  }
  if (auto status = CheckPoses(field, delta); !status.ok()) return status;
  if (auto status = CheckBound(field, delta.bound); !status.ok()) return status;
  if (auto status = CheckCompletion(field, delta); !status.ok()) return status;
  if (base != nullptr && base->given() != delta.given) base = nullptr;
  if (base == nullptr && delta.keeps_future) {
    return Malformed(absl::StrCat(field, ".keeps_future: there is none"));
  }
  MovingObject object;
  if (base != nullptr) object = *base;
  object.id = delta.id;
  object.also = delta.also;
  object.older_ids_told = delta.older_ids_told;
  object.part_of = delta.part_of;
  object.completion = delta.completion;
  object.history = delta.history;
  object.future = delta.keeps_future ? FutureAfter(base->future, object.t_k()) : delta.future;
  object.future_velocity_O = delta.future_velocity_O;
  object.velocity_O = delta.velocity_O;
  object.bound = delta.bound;
  object.tracked_since = delta.tracked_since;
  object.placed_at = delta.placed_at;
  object.estimated = delta.estimated;
  object.reported = delta.reported;
  object.T_B_O = delta.T_B_O;
  object.first_seen = delta.first_seen;
  object.last_seen = delta.last_seen;
  object.frames_seen = delta.frames_seen;
  object.bridged = delta.bridged;
  if (auto status = delta.given ? ApplyShape(field, base, delta, params, object)
                                : ApplyVoxels(field, base, delta, params, object);
      !status.ok()) {
    return status;
  }
  return std::make_shared<const MovingObject>(std::move(object));
}

}  // namespace clearway
