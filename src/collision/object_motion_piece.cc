#include "collision/object_motion_piece.h"

#include <algorithm>

namespace clearway {
namespace {

ObjectPiece Resting(const Pose& T_W_O, Time from, Time until) {
  ObjectPiece piece;
  piece.start = from;
  piece.until = until;
  piece.T_W_O = T_W_O;
  return piece;
}

// Between two poses, known or stated, as Interpolate.
ObjectPiece Between(const StampedPose& before, const StampedPose& after, Time from, Time last) {
  ObjectPiece piece = Resting(before.T_W_O, from, std::min(last, after.stamp));
  piece.start = before.stamp;
  piece.velocity_O =
      (1 / ToSeconds(after.stamp - before.stamp)) * Log(Inverse(before.T_W_O) * after.T_W_O);
  return piece;
}

}  // namespace

ObjectPiece PieceFrom(const MovingObject& object, Time t, Time last, Duration horizon) {
  const StampedPose &oldest = object.history.front(), &newest = object.LastPose();
  if (t < oldest.stamp) return Resting(oldest.T_W_O, t, std::min(last, oldest.stamp));
  if (t < newest.stamp) {
    const auto [before, after] = object.IntervalAt(t);
    return Between(*before, *after, t, last);
  }
  const Twist velocity_O = object.LastVelocity();
  if (velocity_O == Twist{}) return Resting(newest.T_W_O, t, last);
  const Time end = newest.stamp + horizon;
  ObjectPiece piece = Resting(newest.T_W_O, t, last);
  piece.start = newest.stamp;
  piece.velocity_O = velocity_O;
  if (t < end) {
    piece.until = std::min(last, end);
    return piece;
  }
  piece.T_W_O = piece.At(end);
  piece.start = end;
  piece.velocity_O = {};
  piece.beyond_horizon = true;
  piece.radius_m = object.solid->radius_m;
  piece.growth_mps = velocity_O.linear.norm();
  return piece;
}

ObjectPiece HeldAt(const MovingObject& object, Time t, Time last, Duration horizon) {
  const PredictedPose at = PredictPose(object, t, horizon);
  ObjectPiece piece = Resting(at.T_W_O, t, last);
  piece.beyond_horizon = at.beyond_horizon_radius_m.has_value();
  piece.radius_m = at.beyond_horizon_radius_m.value_or(0);
  return piece;
}

}  // namespace clearway
