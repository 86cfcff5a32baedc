// The points of a frame that have a given object's label.
#pragma once

#include "clearway/scene/scene_builder.h"
#include "scene/given_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// Points of given objects add nothing to them. Where most of them lie metres from where the frame,
// or else the scene, has the object, the label means something else: they become background, so
// that their place is not free, the report names the object, and its motion and pose are left out.
void LeaveOutPointsOfGiven(const SceneObjects& objects, Time stamp, const SceneParams& params,
                           LabelledCloud& cloud, ClueMap& clues, FrameReport& report);

}  // namespace clearway
