// Where frames come from: a folder, a recording, the simulator.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/scene/frame.h"

namespace clearway {

// A sequence of frames, read by index. A value; `read` may be called from one thread at a time.
struct FrameSource {
  std::string description;  // for people: what and where
  std::size_t frame_count = 0;
  double resolution_m = 0.1;  // voxel size that suits the data
  std::function<absl::StatusOr<Frame>(std::size_t index)> read;
};

}  // namespace clearway
