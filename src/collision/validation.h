// What a checker refuses.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// INVALID_ARGUMENT naming the field: arrays that do not fit each other or the robot, poses that are
// not finite or not of unit rotation, times whose differences could overflow. A pose anywhere is
// valid; far off it is out of bounds.
absl::Status Validate(const StateBatch& states, const Robot& robot);
absl::Status ValidateTime(const std::string& field, Time time);
absl::Status ValidateStates(const std::vector<Time>& times, const std::vector<Pose>& T_W_L,
                            const Robot& robot);

}  // namespace clearway
