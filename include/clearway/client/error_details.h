// What a server says about an error, beside its code and message.
#pragma once

#include <optional>
#include <string>

#include "absl/status/status.h"
#include "clearway/base/time.h"

namespace clearway {

// The google.rpc details that came with a status of the client library. A plain value.
struct ErrorDetails {
  std::string reason;                   // ErrorInfo, for programs: "STAMP_GOES_BACK"; empty if none
  std::string field;                    // BadRequest: "frame.motions[2].world_motion"
  std::optional<Duration> retry_after;  // RetryInfo
};
ErrorDetails DetailsOf(const absl::Status& status);

}  // namespace clearway
