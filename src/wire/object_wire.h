// Converters of object_service.proto and lease_service.proto.
#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/scene/given_object.h"
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

void Write(const GivenObject& object, v1::GivenObject* proto);
void Write(const ObjectFuture& future, v1::ObjectFuture* proto);
// Check what the messages themselves can get wrong and the limits; the rest is for SceneBuilder.
absl::StatusOr<std::vector<GivenObject>> ReadGivenObjects(const v1::AddObjectsRequest& proto,
                                                          const ServerLimits& limits);
absl::StatusOr<std::vector<ObjectFuture>> ReadFutures(const v1::SetFuturesRequest& proto,
                                                      const ServerLimits& limits);

}  // namespace clearway
