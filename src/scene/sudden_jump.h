// Motions and poses that leave an object's own way.
#pragma once

#include "clearway/scene/scene_builder.h"
#include "scene/given_object.h"
#include "scene/object_update.h"

namespace clearway {

// Takes motions and poses out of the clues of seen objects that put them much farther from where
// they were predicted, or turn them much farther, than predictions are wrong by: where two tracks
// swap their ids, say, or a box is turned round. The velocity that followed from them would carry
// the object away within a frame. The report names them. Without them an object is placed by
// prediction and its points, or begins anew (PlaceByPoints).
void LeaveOutJumps(const SceneObjects& objects, Time stamp, const SceneParams& params,
                   ClueMap& clues, FrameReport& report);

}  // namespace clearway
