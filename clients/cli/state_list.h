// Robot states from flags and files.
#pragma once

#include <string>
#include <string_view>
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

// A table with a header line: columns x, y, z; yaw, or qx, qy, qz, qw; and, if wanted, t. A byte
// order mark and lines that are empty or start with '#' are skipped. `name` names it in messages.
// INVALID_ARGUMENT names the line and column: every state is a question, so a bad row is not left
// out as one of a recording is.
absl::StatusOr<std::vector<TimedBase>> ReadStates(const std::string& name, std::string_view bytes);

// Every link placed by its fixed pose on the base.
StateBatch BatchOf(const std::vector<TimedBase>& states, const std::vector<Pose>& T_R_L,
                   Time newest);

}  // namespace clearway::cli
