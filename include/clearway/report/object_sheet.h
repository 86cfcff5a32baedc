// Close-ups of what was reconstructed of the objects.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// What a sheet shows. A plain value.
struct ObjectSheetOptions {
  std::string title;
  int width_px = 1600;
  std::vector<ObjectId> objects;          // in this order; empty: all of the scene
  std::map<ObjectId, std::string> names;  // by default the ids
};

// Writes a PNG with one row for each object: its occupied voxels obliquely, from above, from the
// side and from the front, all views of a row to one scale; nearer voxels are darker. At most
// 30,000 pixels high, about 80 rows: then it says how many more objects there are. NOT_FOUND for
// an object that is not in the scene, INTERNAL if the file cannot be written.
absl::Status WriteObjectSheet(const SceneSnapshot& scene, const ObjectSheetOptions& options,
                              const std::string& png_file);

}  // namespace clearway
