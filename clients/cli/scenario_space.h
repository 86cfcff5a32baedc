// The configuration space of a scenario file.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "clearway/collision/plan_task.h"
#include "cli/json.h"

namespace clearway::cli {

// {"type": "plane", ...}, "flight" or "arm". Errors name `path`'s fields.
absl::StatusOr<ConfigurationSpace> ParseSpace(const Json& value, const std::string& path);

}  // namespace clearway::cli
