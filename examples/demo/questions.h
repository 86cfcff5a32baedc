// What the demo asks the server beside checks, as tables and as JSON.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/client/scene_client.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway::demo {

// One answer in both forms.
struct Answer {
  std::string table;
  nlohmann::ordered_json json;
};

using Names = std::map<ObjectId, std::string>;

// The objects of at least version `scene.version`: frames seen, voxels, size (of the smallest
// upright box, from `scene`), speed.
absl::StatusOr<Answer> AskObjects(const SceneClient& client, const SceneSnapshot& scene,
                                  const Names& names);

// What the places where moving objects are now, and where they will be 1.5 s later, are occupied by
// over the next seconds.
absl::StatusOr<Answer> AskOccupancy(const SceneClient& client, const SceneSnapshot& scene,
                                    const Names& names);

}  // namespace clearway::demo
