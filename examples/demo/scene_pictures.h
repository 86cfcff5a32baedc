// What the demo knows at its end, as pictures.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "clearway/scene/scene_snapshot.h"
#include "demo/sequence.h"

namespace clearway::demo {

// overview.png, the map from above, and objects.png, each object as it is reconstructed.
absl::Status DrawScene(const SceneSnapshot& scene, const Sequence& sequence,
                       const std::filesystem::path& folder);

}  // namespace clearway::demo
