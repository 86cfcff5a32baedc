// Robot states from flags and files.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/state_checker.h"
#include "cli/values.h"

namespace clearway::cli {

// Where the robot's base R is, and when.
struct TimedBase {
  Pose T_W_R;
  TimeArgument time;
};

// "x,y,z,yaw" or "x,y,z,yaw,t": metres, radians, and a time as ParseTime reads it (default: now).
absl::StatusOr<TimedBase> ParseState(const std::string& text);

// A table with a header line: columns x, y, z; yaw, or qx, qy, qz, qw; and, if wanted, t. Lines
// that are empty or start with '#' are left out. `name` names it in messages. INVALID_ARGUMENT
// names the line and column.
absl::StatusOr<std::vector<TimedBase>> ReadStates(const std::string& name, std::istream& in);

// Every link placed by its fixed pose on the base.
StateBatch BatchOf(const std::vector<TimedBase>& states, const std::vector<Pose>& T_R_L,
                   Time newest);

}  // namespace clearway::cli
