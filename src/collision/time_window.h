// Windows of time that are searched for intervals.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "clearway/collision/safe_intervals.h"

namespace clearway {

// INVALID_ARGUMENT naming the field: times beyond 2^62 ns, a window that ends before it begins,
// lasts more than 2^61 ns or holds more than 100,000 steps, a step that is not above 0.
absl::Status ValidateWindow(const TimeInterval& window, const std::string& step_field,
                            Duration step);

}  // namespace clearway
