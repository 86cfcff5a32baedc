// Sequences of the KITTI tracking benchmark, in the layout in which they are published.
#pragma once

#include <filesystem>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// Whether that is the folder of a sequence's scans: <root>/velodyne/<sequence>.
bool IsKittiTracking(const std::filesystem::path& scans);

// Reads <root>/velodyne/<sequence>/NNNNNN.bin with calib, oxts and label_02/<sequence>.txt beside
// it (https://www.cvlibs.net/datasets/kitti/eval_tracking.php; Geiger et al., "Are we ready for
// Autonomous Driving?", 2012). W is east, north, up (Mercator's, as the raw data's development kit
// has it) from where the first frame's IMU is. Ids are the track's number + 1, so that none is 0;
// frames are 0.1 s apart.
//
// Points in a track's box are its object's. Outside the camera's view nothing is labelled, nor is
// it in the image's regions called DontCare: those points are left out (kIgnoreLabel). Other ones
// are static. Boxes do not say how many points they hold. LidarFolderOptions::poses must be kAny or
// kOxts. Errors as OpenLidarFolder's.
absl::StatusOr<LidarFolder> OpenKittiTracking(const std::filesystem::path& scans,
                                              const LidarFolderOptions& options = {});

}  // namespace clearway
