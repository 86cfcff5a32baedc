// Motions and poses that an object's own points speak against.
#pragma once

#include "clearway/scene/scene_builder.h"
#include "scene/given_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// Takes motions and poses out of the clues that put an object metres from its points, where the
// points are as predicted, or tens of metres: its map would grow by what lies between. The report
// names them. Without them an object is placed by prediction and its points, or begins anew
// (PlaceByPoints).
void LeaveOutContradicted(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                          const SceneParams& params, ClueMap& clues, FrameReport& report);

}  // namespace clearway
