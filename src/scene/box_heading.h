// Boxes whose heading is wrong.
#pragma once

#include "clearway/scene/frame.h"
#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// In a longer gap anything can turn.
inline constexpr Duration kMaxGapOfHeadings = std::chrono::milliseconds(900);

// T_B_O from this pose of the object's box on. Where the box is suddenly turned, and stays so
// (LeaveOutJumps leaves out the first such pose), the object is not. Detectors mistake a front for
// a rear or a side, so the box is taken to be off by right angles, or else by its difference from
// the prediction. The object must have a T_B_O.
Pose FrameInBox(const ObjectPose& pose, Time stamp, const SceneParams& params,
                const MovingObject& object);

}  // namespace clearway
