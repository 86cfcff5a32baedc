// The course from above, and what became of the robot in it.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "closed_loop/loop.h"

namespace clearway::closed_loop {

// Writes a PNG of the way up to `until`, over the map of that time, with what moved every two
// seconds.
absl::Status WritePicture(const Course& course, const LoopResult& result,
                          const SceneSnapshot& scene, Time until, const std::string& png_file);

}  // namespace clearway::closed_loop
