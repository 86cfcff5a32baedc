// Recordings of boxes without scans, as frames for a scene.
#pragma once

#include <string>
#include <vector>

#include "clearway/io/lidar_folder.h"
#include "cli/tracks.h"

namespace clearway::bench {

// Tracks as a folder of boxes of that type, with the motions between them. Times are rounded to
// milliseconds; what does not move is left out.
LidarFolder FolderOf(const std::vector<cli::Track>& tracks, const std::string& type);

}  // namespace clearway::bench
