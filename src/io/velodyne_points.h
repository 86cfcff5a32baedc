// The files of points of KITTI's benchmarks.
#pragma once

#include <filesystem>

#include "absl/status/status.h"
#include "clearway/scene/frame.h"

namespace clearway {

// Sets the points of a file of records of float32 x, y, z, reflectance. NOT_FOUND;
// INVALID_ARGUMENT for a file that is cut off.
absl::Status ReadVelodynePoints(const std::filesystem::path& path, Frame& frame);

}  // namespace clearway
