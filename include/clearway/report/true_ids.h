// A scene as if the source had never taken one object for two.
#pragma once

#include <map>

#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// The scene with its objects under their true ids alone, by the id that each goes by first. Of
// several that are one in truth it holds the one that was seen last.
ScenePtr WithTrueIds(const SceneSnapshot& scene, const std::map<ObjectId, ObjectId>& true_ids);

}  // namespace clearway
