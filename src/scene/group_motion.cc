#include "scene/group_motion.h"

#include <algorithm>
#include <utility>

#include "scene/object_motion.h"
#include "scene/position_bound.h"
#include "scene/prospect.h"

namespace clearway {
namespace {

// The velocity of the same rigid motion in another frame. Murray, Li, Sastry, "A Mathematical
// Introduction to Robotic Manipulation", 1994, section 2.4 (adjoint transformation).
Twist InFrame(const Pose& T_P_O, const Twist& velocity_O) {
  const Eigen::Vector3d angular_P = T_P_O.rotation * velocity_O.angular;
  return {angular_P, T_P_O.rotation * velocity_O.linear + T_P_O.translation.cross(angular_P)};
}

// With what velocity (in P) a part went on with the leader, as that was known by then; none if too
// little of it was.
std::optional<Twist> VelocityAlong(const StampedPose& part, const MovingObject& leader,
                                   const SceneParams& params) {
  const auto& history = leader.history;
  const auto later = std::ranges::upper_bound(history, part.stamp, {}, &StampedPose::stamp);
  const std::span past(history.begin(), later);
  if (past.size() < 2) return std::nullopt;
  const Twist velocity_O = GoesOnByItself(past, *leader.solid, params);
  const Pose T_W_O = PredictPose(leader, part.stamp, params.horizon).T_W_O;
  return InFrame(Inverse(part.T_W_O) * T_W_O, velocity_O);
}

}  // namespace

MovingObject WithFutureOf(MovingObject part, const MovingObject& leader, const Pose& T_O_P) {
  part.future = FutureAfter(leader.future, part.t_k());
  for (StampedPose& pose : part.future) pose.T_W_O = pose.T_W_O * T_O_P;
  part.future_velocity_O =
      part.future.empty() ? Twist{} : InFrame(Inverse(T_O_P), leader.future_velocity_O);
  return part;
}

MovingObject GoingAlong(MovingObject part, const MovingObject& leader, const SceneParams& params) {
  const auto by_itself = [&](std::span<const StampedPose> past) {
    return GoesOnByItself(past, *part.solid, params);
  };
  const auto along = [&](std::span<const StampedPose> past) {
    const std::optional<Twist> velocity_P = VelocityAlong(past.back(), leader, params);
    return velocity_P ? *velocity_P : by_itself(past);
  };
  const Pose T_O_P = Inverse(leader.history.back().T_W_O) * part.history.back().T_W_O;
  const PastMisses misses_by_itself =
      MissesOf(part.history, part.tracked_since, *part.solid, by_itself);
  const PastMisses misses_along = MissesOf(part.history, part.tracked_since, *part.solid, along);
  const bool alone = leader.future.empty() && part.velocity_O && part.history.size() > 1 &&
                     IsClearlyBetter(misses_by_itself, misses_along);
  Prospect prospect;
  if (alone) {
    prospect = ProspectOf(part.history, part.tracked_since, LastMotionOf(part.history), *part.solid,
                          params);
  } else {
    prospect.velocity_O = InFrame(Inverse(T_O_P), *leader.velocity_O);
    prospect.bound = BoundBy(misses_along, part.history.size() > 1, prospect.velocity_O,
                             params.motion == MotionModel::kLastMotion);
  }
  part.velocity_O = prospect.velocity_O;
  part.bound = Saturated(prospect.bound);
  return WithFutureOf(std::move(part), leader, T_O_P);
}

}  // namespace clearway
