// What a late frame does to an object that a newer frame has placed.
#pragma once

#include "scene/object_update.h"

namespace clearway {

// Whether a newer frame has placed the object already. Given objects have their own rule
// (OutOfReach).
bool IsNewerThan(const MovingObject& object, Time stamp);

// Where O was at a stamp before t_k: between the poses of its history; before the first of them as
// the frame's pose of its box says, else carried back by its velocity.
Pose PoseBefore(const MovingObject& object, const ObjectClue& clue, Time stamp,
                const SceneParams& params);

// The object with its points of a late frame, which must be at least one, in its map. Its poses,
// its motion and its future stay.
MovingObject WithLatePoints(const MovingObject& object, const LabelledCloud& cloud,
                            const ObjectClue& clue, Time stamp, const SceneParams& params,
                            ThreadPool& pool);

}  // namespace clearway
