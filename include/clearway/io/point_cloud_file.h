// Unlabelled point clouds: text, and OctoMap's scan graphs.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/geometry/pose.h"

namespace clearway {

// Points with the pose of the sensor that saw them.
struct PosedCloud {
  Pose T_W_S;
  std::vector<Eigen::Vector3f> points_S;  // metres
};

// A text of lines with x, y and z, separated by blanks; lines that are empty or start with # are
// left out. INVALID_ARGUMENT names the line: fewer or more than three numbers, one that is not
// finite, a last line that does not end.
absl::StatusOr<PosedCloud> ParseTextCloud(const std::string& name, std::string_view text);

// The nodes of an OctoMap scan graph (.graph, binary); its edges are checked and left out.
// INVALID_ARGUMENT names the byte at which it is cut off or not one.
absl::StatusOr<std::vector<PosedCloud>> ParseScanGraph(const std::string& name,
                                                       std::string_view bytes);

// Reads a .graph, or any other file as text.
absl::StatusOr<std::vector<PosedCloud>> ReadPointClouds(const std::filesystem::path& path);

}  // namespace clearway
