// Where frames come from: a folder, a recording, the simulator.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/left_out.h"
#include "clearway/scene/frame.h"

namespace clearway {

// A sequence of frames, read by index. A value; `read` may be called from one thread at a time.
struct FrameSource {
  std::string description;  // for people: what and where
  std::size_t frame_count = 0;
  double resolution_m = 0.1;  // voxel size that suits the data
  // How far the sensor's poses are off, on average, as SceneParams takes it; 0 if they are as good
  // as the scans, or nothing is known of it.
  double sensor_pose_error_m = 0, sensor_pose_error_rad = 0;
  // Where the origin of W lies in the source's own world; zero unless it was moved
  // (world_origin.h).
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();
  // What of the files cannot be used; complete once every frame was read. Copies share it.
  std::shared_ptr<LeftOut> left_out = std::make_shared<LeftOut>();
  std::function<absl::StatusOr<Frame>(std::size_t index)> read;
};

}  // namespace clearway
