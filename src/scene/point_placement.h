// Objects of which a frame gives points, but not where they are.
#pragma once

#include <optional>

#include "clearway/scene/scene_builder.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// Compares the clue's points with where the object is predicted, if the frame gives neither a
// motion nor a pose of it, or a motion that starts from a predicted pose. Notes in the clue where
// the points put the object. Returns why they cannot be the object's: it has to begin anew.
std::optional<ObjectIssue> PlaceByPoints(const MovingObject& object, const LabelledCloud& cloud,
                                         Time stamp, const SceneParams& params,
                                         const FrameLimits& limits, ObjectClue& clue);

}  // namespace clearway
