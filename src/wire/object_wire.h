// Converters of object_service.proto and lease_service.proto.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/v1/lease_service.pb.h"
#include "clearway/v1/object_service.pb.h"
#include "clearway/wire/answers.h"

namespace clearway {

void Write(const ObjectInfo& object, v1::ObjectInfo* proto);
absl::StatusOr<ObjectInfo> ReadObject(const v1::ObjectInfo& proto);

void Write(const PredictedPoses& poses, v1::PredictPosesResponse* proto);
// `times`: how many were asked for.
absl::StatusOr<PredictedPoses> ReadPredictedPoses(const v1::PredictPosesResponse& proto,
                                                  std::size_t times);

}  // namespace clearway
