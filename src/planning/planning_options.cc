#include "clearway/planning/planning_options.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"

namespace clearway {
namespace {

absl::Status CheckPositive(const char* field, double value) {
  if (value > 0 && std::isfinite(value)) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, ": ", NumberText(value), " is not finite and above 0"));
}

}  // namespace

MotionOptions MotionOptionsOf(const PlanningOptions& options) {
  MotionOptions of_motions{options.check, options.contact_resolution_m, std::nullopt};
  of_motions.check.clearance_up_to_m.reset();
  of_motions.check.with_unknown_fraction = false;
  return of_motions;
}

absl::Status Validate(const PlanningOptions& options, const Robot& robot) {
  if (absl::Status status = Validate(options.check, robot); !status.ok()) return status;
  if (absl::Status status = Validate(MotionOptionsOf(options), robot); !status.ok()) return status;
  if (absl::Status status = CheckPositive("step_m", options.step_m); !status.ok()) return status;
  if (absl::Status status = CheckPositive("time_step", ToSeconds(options.time_step));
      !status.ok()) {
    return status;
  }
  if (absl::Status status = CheckPositive("max_states_per_motion", options.max_states_per_motion);
      !status.ok()) {
    return status;
  }
  return CheckPositive("clearance_up_to_m", options.clearance_up_to_m);
}

}  // namespace clearway
