// How a part of an object goes on with the others.
#pragma once

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The part as it goes on with an object of its group whose newest pose is of the same time: on
// along the same rigid motion, its place in the group frozen, and along the same stated future. A
// trailer in a steady turn does just that, and swinging legs stay near it. Where the part's own
// past tells that it clearly was better predicted by itself (the boom of an excavator that stands),
// it goes on by itself, unless a future is stated. Its bound is that of the way it goes.
MovingObject GoingAlong(MovingObject part, const MovingObject& leader, const SceneParams& params);

// The part with what is stated of the leader's future, carried over to its own frame P.
MovingObject WithFutureOf(MovingObject part, const MovingObject& leader, const Pose& T_O_P);

}  // namespace clearway
