// Converters of check_service.proto for motions.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/collision/motion.h"
#include "clearway/v1/check_service.pb.h"
#include "clearway/wire/server_info.h"

namespace clearway {

void Write(const MotionOptions& options, v1::CheckMotionsRequest* proto);
absl::StatusOr<MotionOptions> ReadMotionOptions(const v1::CheckMotionsRequest& proto,
                                                const ServerLimits& limits);

// Motions [begin, end) of the batch, the first of which begins at `knot`; the batch must fit.
void WriteMotions(const MotionBatch& motions, std::size_t links, std::size_t begin, std::size_t end,
                  std::size_t knot, v1::CheckMotionsRequest* proto);
// RESOURCE_EXHAUSTED for more knots than states may be.
absl::StatusOr<MotionBatch> ReadMotions(const v1::CheckMotionsRequest& proto, std::size_t links,
                                        const ServerLimits& limits);

void Write(const MotionReply& reply, v1::CheckMotionsResponse* proto);
// INTERNAL if the reply does not have `motions` answers.
absl::StatusOr<MotionReply> ReadMotionReply(const v1::CheckMotionsResponse& proto,
                                            std::size_t motions);

}  // namespace clearway
