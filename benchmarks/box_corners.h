// Recorded boxes in place of what a sensor sees of them.
#pragma once

#include <span>

#include "clearway/io/lidar_folder.h"
#include "clearway/scene/frame.h"

namespace clearway::bench {

// The boxes of that frame.
std::span<const RecordedBox> BoxesOf(const LidarFolder& folder, int frame);

// Replaces the frame's scan by the corners of its boxes.
void SeeBoxes(const LidarFolder& folder, Frame& frame);

}  // namespace clearway::bench
