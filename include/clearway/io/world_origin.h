// Moves the origin of a source's world, for data in UTM and other frames whose origin is far away.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// Coordinates of files may be this large before their origin is moved: enough for UTM, ECEF and
// national grids with a zone before the easting.
inline constexpr double kMaxFileCoordinate_m = 1e8;

// The point of a source's own world that becomes the origin of W.
struct WorldOrigin {
  // Where the sensor is at the source's first pose; else `position_m` in the source's own world.
  bool at_first_pose = false;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
};

// "500000,4100000,12.5": as many digits as it takes to read the same numbers again.
std::string OriginText(const Eigen::Vector3d& origin_m);

// Subtracts the origin from everything that frames, poses and boxes place in the world, in double
// precision, and adds it to FrameSource::origin_m. Without an origin nothing changes.
//
// INVALID_ARGUMENT, naming the limit, if most poses of the sensor then still lie beyond
// FrameLimits::max_coordinate_m, where a scene takes no frame.
absl::StatusOr<LidarFolder> WithOrigin(LidarFolder folder,
                                       const std::optional<WorldOrigin>& origin);
// The same of frames alone; `at_first_pose` and the limit go by the first that can be read. With
// `at_first_pose`, the first frame's error if none can.
absl::StatusOr<FrameSource> WithOrigin(FrameSource source,
                                       const std::optional<WorldOrigin>& origin);

}  // namespace clearway
