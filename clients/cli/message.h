// Errors as a person reads them.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace clearway::cli {

// An error of the command line that only shows once its flags are seen together.
absl::Status UsageError(const std::string& message);
bool IsUsageError(const absl::Status& status);

// One or two lines without the status code's name where the message stands for itself.
std::string MessageFor(const absl::Status& status);

// The same error, its message behind "<context>: ".
absl::Status InContext(const std::string& context, const absl::Status& status);

}  // namespace clearway::cli
