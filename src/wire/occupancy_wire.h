// Converters of the answers of occupancy_service.proto.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/v1/occupancy_service.pb.h"
#include "clearway/wire/answers.h"

namespace clearway {

// Readers refuse (INTERNAL) an answer whose arrays do not fit together.

void Write(const PointAnswers& answer, v1::GetPointOccupancyResponse* proto);
absl::StatusOr<PointAnswers> ReadPoints(const v1::GetPointOccupancyResponse& proto);

void Write(const BoxOccupancy& answer, v1::GetBoxOccupancyResponse* proto);
absl::StatusOr<BoxOccupancy> ReadBoxOccupancy(const v1::GetBoxOccupancyResponse& proto);

void Write(const SliceOccupancy& answer, v1::GetSliceOccupancyResponse* proto);
absl::StatusOr<SliceOccupancy> ReadSlice(const v1::GetSliceOccupancyResponse& proto);

void Write(const RayAnswers& answer, v1::CastRaysResponse* proto);
absl::StatusOr<RayAnswers> ReadRays(const v1::CastRaysResponse& proto);

}  // namespace clearway
