// The scene that the demo keeps.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/scene_params.h"
#include "clearway/scene/scene_snapshot.h"
#include "demo/sequence.h"

namespace clearway::demo {

// For plans made once, or for crossings that are driven.
SceneParams ParamsFor(const Sequence& sequence, bool drive);
// The same as flags of the server.
std::vector<std::string> ServerFlags(const SceneParams& params);

// The scene of all frames, made in this process.
absl::StatusOr<ScenePtr> SceneAtTheEnd(const Sequence& sequence, const SceneParams& params);

}  // namespace clearway::demo
