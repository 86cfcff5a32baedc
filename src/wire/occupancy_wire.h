// Converters of the answers of occupancy_service.proto.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/v1/occupancy_service.pb.h"
#include "clearway/wire/answers.h"

namespace clearway {

// Readers refuse (INTERNAL) an answer whose arrays do not fit together.

// Writes the answers of so many points in place, in any order. One thread; the message must outlive
// it.
class PointWriter {
 public:
  // `any_dynamic`: whether the scene has dynamic space.
  PointWriter(const Versioned& scene, bool any_dynamic, std::size_t points,
              v1::GetPointOccupancyResponse* proto);
  void Set(std::size_t i, const PointOccupancy& point);

 private:
  int* statuses_;
  std::int32_t* object_ids_;
  double* fused_log_odds_;
  bool* dynamic_ = nullptr;  // null where nothing is
};
absl::StatusOr<PointAnswers> ReadPoints(const v1::GetPointOccupancyResponse& proto);

void Write(const BoxOccupancy& answer, v1::GetBoxOccupancyResponse* proto);
absl::StatusOr<BoxOccupancy> ReadBoxOccupancy(const v1::GetBoxOccupancyResponse& proto);

void Write(const SliceOccupancy& answer, v1::GetSliceOccupancyResponse* proto);
absl::StatusOr<SliceOccupancy> ReadSlice(const v1::GetSliceOccupancyResponse& proto);

void Write(const RayAnswers& answer, v1::CastRaysResponse* proto);
absl::StatusOr<RayAnswers> ReadRays(const v1::CastRaysResponse& proto);

}  // namespace clearway
