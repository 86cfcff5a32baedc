// The server's errors of a scenario, in the words of its file.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace clearway::cli {

// "file: field: ..." of an error that names a field of a request; another one as it is.
absl::Status InScenario(const std::string& file, const absl::Status& status);

}  // namespace clearway::cli
