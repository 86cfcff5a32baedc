// Errors on the wire: canonical codes with google.rpc details.
#pragma once

#include <optional>
#include <string>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "google/rpc/status.pb.h"

namespace clearway {

// INVALID_ARGUMENT for a field of a request; all layers write such messages as "field: what is
// wrong", which is how the field gets into BadRequest.
absl::Status FieldError(const std::string& field, const std::string& what);
// RESOURCE_EXHAUSTED, naming both numbers.
absl::Status LimitError(const std::string& field, std::uint64_t size, std::uint64_t limit);
// The same error with `prefix` before the field that its message starts with.
absl::Status WithFieldPrefix(const std::string& prefix, const absl::Status& status);
// The same error with another ErrorInfo.reason than its code's own.
absl::Status WithReason(absl::Status status, const std::string& reason);

// The field that the message starts with; empty if it does not look like one.
std::string FieldOf(const absl::Status& status);

// ErrorInfo always; BadRequest for INVALID_ARGUMENT; RetryInfo for UNAVAILABLE and
// RESOURCE_EXHAUSTED.
google::rpc::Status ToProto(const absl::Status& status);
// Details become payloads of the status, under their type URLs. A code that does not exist is
// UNKNOWN.
absl::Status FromProto(const google::rpc::Status& proto);

// Of a status that FromProto made.
std::string ReasonOf(const absl::Status& status);
std::string BadFieldOf(const absl::Status& status);
std::optional<Duration> RetryDelayOf(const absl::Status& status);

}  // namespace clearway
