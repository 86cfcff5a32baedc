#include "scene/object_update.h"

#include <algorithm>
#include <cmath>

#include "scene/box_heading.h"
#include "scene/mended_pose.h"
#include "scene/motion_from_points.h"
#include "scene/object_motion.h"
#include "scene/position_bound.h"
#include "scene/prospect.h"

namespace clearway {
namespace {

// Poses to come whose time has come are forgotten: the new one counts.
void Remember(MovingObject& object, const StampedPose& pose, Duration history) {
  if (!object.history.empty() && object.t_k() == pose.stamp) {
    object.history.back() = pose;
  } else {
    object.history.push_back(pose);
  }
  const auto keep =
      std::find_if(object.history.begin(), object.history.end() - 1,
                   [&](const StampedPose& p) { return p.stamp >= pose.stamp - history; });
  object.history.erase(object.history.begin(), keep);
  object.future = FutureAfter(object.future, pose.stamp);
  if (object.future.empty()) object.future_velocity_O = {};
}

// To that of the step that leads there from `from`, or, if it is too short or turns too far, from
// an earlier pose.
void SetVelocity(const StampedPose* from, const StampedPose& to, const BodyBox& body,
                 MovingObject& object) {
  const bool is_long = from != nullptr && to.stamp - from->stamp >= kShortestStep;
  if (!is_long) from = StepBefore(object.history, to.stamp);
  if (from == nullptr) return;
  if (TurnsTooFar(*from, to, body)) {
    const StampedPose* const alike = PoseAlike(object.history, to);
    if (alike != nullptr) from = alike;
  }
  object.velocity_O = VelocityOfStep(*from, to, body, object.velocity_O);
}

// The motion between two reported poses is known from these two alone, so what was predicted or
// estimated in between is forgotten. After a longer gap the track is young again: what
// the object did in between is not known.
void ForgetPredictions(Time stamp, MovingObject& object) {
  constexpr Duration kLongGap = std::chrono::seconds(1);
  const bool was_estimated = object.estimated && object.reported;
  if (!object.bridged && !was_estimated) return;
  const auto predicted =
      std::ranges::upper_bound(object.history, object.placed_at, {}, &StampedPose::stamp);
  object.history.erase(predicted, object.history.end());
  object.bridged = stamp - object.placed_at > kLongGap;
}

// After a pose that is no prediction, be it a motion from a predicted one: then what was missed in
// between is not known.
void SetMotion(MovingObject& object, bool after_gap, const SceneParams& params) {
  if (object.bridged || after_gap) object.tracked_since = object.t_k();
  object.bridged = false;
  object.placed_at = object.t_k();
  const auto [velocity_O, bound] =
      ProspectOf(object.history, object.tracked_since, object.velocity_O.value_or(Twist{}),
                 *object.solid, params);
  if (object.velocity_O) object.velocity_O = velocity_O;
  object.bound = Saturated(bound);
}

// Of an object of which no motion is known.
PositionBound FirstBound(const MovingObject& object, const SceneParams& params) {
  const StampedPose& last = object.history.back();
  return BoundOf({&last, 1}, last.stamp, {}, *object.solid, params);
}

// Where O begins: its voxels are then W's moved by a quarter, however a wrong label or two moves
// the mean of the points. Not W's themselves: what people build has round measures, and of a
// surface between two voxels rounding would fill both.
Eigen::Vector3d OriginNear(const Eigen::Vector3d& p_W, double voxel_m) {
  return voxel_m * ((p_W / voxel_m).array().round() + 0.25);
}

// To where its points put it. Their noise is that of registration: a track evens it out.
void Estimate(const Pose& T_W_O, Time stamp, const SceneParams& params, MovingObject& object) {
  SetVelocity(nullptr, {stamp, T_W_O}, BoxOf(*object.solid), object);
  Remember(object, {stamp, T_W_O}, params.history);
  SceneParams of_track = params;
  of_track.motion = MotionModel::kTrack;
  const Time reported_at = object.placed_at;
  SetMotion(object, false, of_track);
  if (object.reported) object.placed_at = reported_at;
  object.estimated = true;
}

// Where prediction and its points put it.
Pose PlaceByItsPoints(const MovingObject& object, const ObjectClue& clue, Time stamp,
                      const SceneParams& params) {
  if (clue.T_W_O_estimated) return *clue.T_W_O_estimated;
  Pose T_W_O = PredictPose(object, stamp, params.horizon).T_W_O;
  T_W_O.translation += clue.off_W;
  return T_W_O;
}

// To where it is predicted, but for what its points say against that.
void Bridge(const ObjectClue& clue, Time stamp, const SceneParams& params, MovingObject& object) {
  // Up to its future's end its poses are stated; beyond it, it goes on as it did there.
  const bool outlived = !object.future.empty() && object.future.back().stamp <= stamp;
  if (outlived) object.velocity_O = object.LastVelocity();
  if (!object.future.empty()) object.placed_at = std::min(stamp, object.future.back().stamp);
  if (object.velocity_O && (outlived || object.future.empty())) {
    object.bound = Saturated(BoundAfter(object.bound, ToSeconds(stamp - object.LastPose().stamp)));
    const PositionBound unknown = FirstBound(object, params);
    const bool rests = *object.velocity_O == Twist{};
    if (rests && unknown.At(1) < object.bound.At(1)) object.bound = unknown;
  }
  Remember(object, {stamp, PlaceByItsPoints(object, clue, stamp, params)}, params.history);
  object.bridged = true;
}

}  // namespace

MovingObject FirstSight(ObjectId id, const LabelledCloud& cloud, const ObjectClue& clue, Time stamp,
                        const SceneParams& params) {
  Eigen::Vector3d centroid_W = Eigen::Vector3d::Zero();
  for (std::uint32_t i : clue.points) centroid_W += cloud.ends_W[i].cast<double>();
  centroid_W /= static_cast<double>(clue.points.size());

  MovingObject object;
  object.id = id;
  object.map_O = VoxelMap(params.object_resolution_m, params.Model());
  object.history = {
      {stamp,
       {Eigen::Quaterniond::Identity(), OriginNear(centroid_W, params.object_resolution_m)}}};
  object.first_seen = stamp;
  const Pose& T_W_O = object.history.back().T_W_O;
  if (clue.motion != nullptr && stamp - clue.motion->from >= kShortestStep) {
    object.velocity_O =
        VelocityBetween({clue.motion->from, Inverse(clue.motion->H_W) * T_W_O}, {stamp, T_W_O});
  }
  if (clue.pose != nullptr) object.T_B_O = Inverse(clue.pose->T_W_B) * T_W_O;
  object.tracked_since = object.placed_at = stamp;
  object.reported = clue.Places();
  object.bound = Saturated(
      BoundOf(object.history, stamp, object.velocity_O.value_or(Twist{}), Solid{}, params));
  return object;
}

void NoteIds(MovingObject& object, const std::vector<ObjectId>& named_as, Time stamp) {
  const std::vector<ObjectId> ids = object.Ids();
  for (std::size_t i = 0; i < object.older_ids_told.size(); ++i) {
    Time& last = object.older_ids_told[i];
    if (std::ranges::find(named_as, ids[i]) != named_as.end()) last = std::max(last, stamp);
  }
}

MovingObject Moved(MovingObject object, const LabelledCloud& cloud, const ObjectClue& clue,
                   Time stamp, const SceneParams& params) {
  bool after_gap = false;
  if (clue.motion != nullptr) {
    after_gap = clue.motion->from - object.t_k() > kNoGap;
    Pose T_W_from = StartOf(*clue.motion, object, stamp, params);
    T_W_from.translation += clue.off_W;
    const Pose T_W_T = CarriedOn(*clue.motion, T_W_from, object);  // eq. 2
    const Pose T_W_O = MendedPose(T_W_T, cloud, clue.points, stamp, params, object);
    if (clue.motion->from <= object.placed_at + kNoGap) ForgetPredictions(stamp, object);
    const StampedPose from{clue.motion->from, T_W_from};
    SetVelocity(&from, {stamp, T_W_O}, BoxOf(*object.solid), object);
    Remember(object, {stamp, T_W_O}, params.history);
  } else if (clue.pose != nullptr) {
    const bool is_first = !object.T_B_O;
    if (is_first) {
      object.T_B_O = Inverse(clue.pose->T_W_B) * PlaceByItsPoints(object, clue, stamp, params);
      object.told.reset();
    }
    object.T_B_O = FrameInBox(*clue.pose, stamp, params, object);
    const Pose T_W_T = clue.pose->T_W_B * *object.T_B_O;
    const Pose T_W_O = MendedPose(T_W_T, cloud, clue.points, stamp, params, object);
    if (!is_first) ForgetPredictions(stamp, object);
    // Whoever reports a box with a wrong heading knows where it is.
    const BodyBox told{Inverse(*object.T_B_O).translation, BoxOf(*object.solid).half_size_m};
    SetVelocity(nullptr, {stamp, T_W_O}, told, object);
    Remember(object, {stamp, T_W_O}, params.history);
  } else if (clue.T_W_O_estimated) {
    Estimate(*clue.T_W_O_estimated, stamp, params, object);
  } else if (!clue.points.empty() && object.t_k() < stamp) {
    Bridge(clue, stamp, params, object);
  }
  if (clue.Places()) {
    SetMotion(object, after_gap, params);
    object.estimated = false;
    object.reported = true;
  }
  NoteIds(object, clue.named_as, stamp);
  return object;
}

Pose StartOf(const ObjectMotion& motion, const MovingObject& object, Time stamp,
             const SceneParams& params) {
  if (object.given() || motion.from >= object.first_seen - kNoGap || object.t_k() >= stamp) {
    return PredictPose(object, motion.from, params.horizon).T_W_O;
  }
  const StampedPose& first = object.history.front();
  const double share = ToSeconds(stamp - first.stamp) / ToSeconds(stamp - motion.from);
  return Inverse(motion.H_W) * Exp(share * Log(motion.H_W)) * first.T_W_O;
}

std::optional<Pose> StatedPose(const MovingObject& object, const ObjectClue& clue, Time stamp,
                               const SceneParams& params) {
  if (clue.motion != nullptr) {
    return clue.motion->H_W * StartOf(*clue.motion, object, stamp, params);
  }
  if (clue.pose != nullptr && object.T_B_O) return clue.pose->T_W_B * *object.T_B_O;
  return std::nullopt;
}

bool StartsAtAPose(const ObjectMotion& motion, const MovingObject& object) {
  return motion.from >= object.first_seen - kNoGap && motion.from <= object.t_k() + kNoGap;
}

bool OutOfReach(const MovingObject& object, const ObjectClue& clue, Time stamp,
                const SceneParams& params) {
  if (stamp < object.t_k()) return true;
  if (clue.pose != nullptr && object.T_B_O) return false;
  const Time needed = clue.motion != nullptr ? clue.motion->from : stamp;
  const bool goes_on = !(object.LastVelocity() == Twist{});
  return goes_on && needed - object.LastPose().stamp > params.horizon;
}

}  // namespace clearway
