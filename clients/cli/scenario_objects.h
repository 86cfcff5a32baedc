// The objects of a scenario file.
#pragma once

#include <filesystem>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/given_object.h"
#include "cli/json.h"

namespace clearway::cli {

// A list of them; times count from Time(). Errors name `path`'s fields.
absl::StatusOr<std::vector<GivenObject>> ParseGivenObjects(const Json& list,
                                                           const std::string& path,
                                                           const std::filesystem::path& folder);

}  // namespace clearway::cli
