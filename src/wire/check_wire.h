// Converters of check_service.proto.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "clearway/collision/state_checker.h"
#include "clearway/v1/check_service.pb.h"
#include "clearway/wire/server_info.h"

namespace clearway {

void Write(const CheckOptions& options, v1::CheckOptions* proto);
// INVALID_ARGUMENT for a policy that is not stated. Whether links exist is for Validate(options,
// robot), which the checker runs.
absl::StatusOr<CheckOptions> ReadCheckOptions(const std::string& field,
                                              const v1::CheckOptions& proto,
                                              const ServerLimits& limits);

// States [begin, end) of the batch.
void WriteStates(const StateBatch& states, std::size_t links, std::size_t begin, std::size_t end,
                 v1::CheckStatesRequest* proto);
absl::StatusOr<StateBatch> ReadStates(const v1::CheckStatesRequest& proto, std::size_t links,
                                      const ServerLimits& limits);

void Write(const CheckReply& reply, v1::CheckStatesResponse* proto);
// INTERNAL if the reply does not have `states` answers.
absl::StatusOr<CheckReply> ReadCheckReply(const v1::CheckStatesResponse& proto, std::size_t states,
                                          const CheckOptions& options);

}  // namespace clearway
