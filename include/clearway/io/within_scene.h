// Leaves out of a folder what a scene would refuse.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// Leaves out what a scene would refuse (FrameLimits), counts and names it in
// `folder.frames.left_out`: frames whose sensor is beyond max_coordinate_m, boxes that are, stamps
// of more than 2^62 ns either way, and a first or last frame alone whose stamp is more than
// max_stamp_jump from the others, as of a clock that was not set yet.
// Comes after WithOrigin, which refuses folders that are far away as a whole.
//
// What is left out does not count, as if the tables did not have it: no motion leads to or from it,
// and boxes of frames that are left out are gone, too.
//
// INVALID_ARGUMENT, with the first reason, if no frame is left; FAILED_PRECONDITION if something is
// to be left out of a folder without frames_without.
absl::StatusOr<LidarFolder> WithinScene(LidarFolder folder);

}  // namespace clearway
