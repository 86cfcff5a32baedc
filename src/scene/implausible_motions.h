// Motions and poses that are well formed, but cannot be right.
#pragma once

#include "clearway/scene/scene_builder.h"
#include "scene/given_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// Takes motions and poses out of the clues, and clues that hold nothing else: motions that turn by
// more than kMaxTurn_rad, those that lead beyond limits.max_coordinate_m (or are translations
// beyond twice that: a turn about a far place is a turn about the origin and a large translation),
// and what moves an object faster than kMaxSpeed_mps. The report names them.
void LeaveOutImplausible(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                         const SceneParams& params, const FrameLimits& limits, ClueMap& clues,
                         FrameReport& report);

// The largest coordinate of the position, as an absolute value.
double LargestCoordinate(const Pose& pose);

}  // namespace clearway
