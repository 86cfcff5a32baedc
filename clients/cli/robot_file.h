// Robots described by a small JSON file; the format is in docs/formats.md, "Robot files".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/robot.h"

namespace clearway::cli {

// A robot whose links stand still on its base R: enough for states that are a pose of the base.
struct RobotFile {
  Robot robot;
  std::vector<Pose> T_R_L;  // one per link
};

// `name` names the file in messages; mesh files are looked for next to it. INVALID_ARGUMENT names
// the field ("robot.json: links[0].shapes[1].radius_m: ...") or the line and column of broken JSON.
absl::StatusOr<RobotFile> ParseRobot(const std::filesystem::path& name, const std::string& text);

// One shape in short: "box:1,0.7,1", "sphere:0.3", "cylinder:0.3,1.2" and "capsule:0.3,0.6"
// (radius, length): one link called "body", centred at the state's position.
absl::StatusOr<RobotFile> ParseShortRobot(const std::string& shape);

// The value of --robot: a robot file, or one shape in short.
absl::StatusOr<RobotFile> LoadRobot(const std::string& file_or_shape);

}  // namespace clearway::cli
