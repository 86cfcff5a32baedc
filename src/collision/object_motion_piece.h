// The parts of an object's way on which it moves alike.
#pragma once

#include "clearway/base/time.h"
#include "clearway/scene/moving_object.h"

namespace clearway {

// Until `until` the object goes along a screw, or rests; beyond its horizon it may be
// anywhere in a ball that grows. What PredictPose says, cut where its form changes. A value.
struct ObjectPiece {
  Time until;
  Pose T_W_O;        // at `start`
  Time start;        // of the screw: at or before the time that was asked for
  Twist velocity_O;  // zero at rest
  bool beyond_horizon = false;
  double radius_m = 0, growth_mps = 0;  // of the ball, about T_W_O's origin: at `start`, and since

  Pose At(Time t) const { return T_W_O * Exp(ToSeconds(t - start) * velocity_O); }
  double RadiusAt(Time t) const { return radius_m + growth_mps * ToSeconds(t - start); }
};

// The piece that holds at `t` and after it, up to `last` at most.
ObjectPiece PieceFrom(const MovingObject& object, Time t, Time last, Duration horizon);
// The object as it is at `t`, held there until `last`.
ObjectPiece HeldAt(const MovingObject& object, Time t, Time last, Duration horizon);

}  // namespace clearway
