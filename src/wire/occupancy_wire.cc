#include "wire/occupancy_wire.h"

#include <cmath>
#include <limits>

#include "wire/scene_wire.h"

namespace clearway {
namespace {

// Absent values of packed arrays.
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::optional<double> Value(double proto) {
  return std::isnan(proto) ? std::nullopt : std::optional(proto);
}

absl::Status Misfit() { return absl::InternalError("the arrays of the server's reply do not fit"); }

std::vector<SpaceStatus> ReadStatuses(const google::protobuf::RepeatedField<int>& proto) {
  std::vector<SpaceStatus> statuses;
  statuses.reserve(proto.size());
  for (int status : proto) statuses.push_back(ReadSpaceStatus(status));
  return statuses;
}

}  // namespace

PointWriter::PointWriter(const Versioned& scene, bool any_dynamic, std::size_t points,
                         v1::GetPointOccupancyResponse* proto) {
  Write(scene, proto->mutable_scene());
  const int size = static_cast<int>(points);
  proto->mutable_statuses()->Resize(size, v1::SPACE_STATUS_UNSPECIFIED);
  proto->mutable_object_ids()->Resize(size, kStaticLabel);
  proto->mutable_fused_log_odds()->Resize(size, kNone);
  statuses_ = proto->mutable_statuses()->mutable_data();
  object_ids_ = proto->mutable_object_ids()->mutable_data();
  fused_log_odds_ = proto->mutable_fused_log_odds()->mutable_data();
  if (!any_dynamic) return;
  proto->mutable_dynamic()->Resize(size, false);
  dynamic_ = proto->mutable_dynamic()->mutable_data();
}

void PointWriter::Set(std::size_t i, const PointOccupancy& point) {
  statuses_[i] = ToProto(point.status);
  object_ids_[i] = point.object;
  fused_log_odds_[i] = point.fused_log_odds.value_or(kNone);
  if (dynamic_ != nullptr) dynamic_[i] = point.dynamic;
}

absl::StatusOr<PointAnswers> ReadPoints(const v1::GetPointOccupancyResponse& proto) {
  const int size = proto.statuses_size();
  const bool has_dynamic = proto.dynamic_size() > 0;
  if (proto.object_ids_size() != size || proto.fused_log_odds_size() != size ||
      (has_dynamic && proto.dynamic_size() != size)) {
    return Misfit();
  }
  PointAnswers answer;
  static_cast<Versioned&>(answer) = ReadVersion(proto.scene());
  answer.points.reserve(size);
  for (int i = 0; i < size; ++i) {
    answer.points.push_back({ReadSpaceStatus(proto.statuses(i)), proto.object_ids(i),
                             Value(proto.fused_log_odds(i)), has_dynamic && proto.dynamic(i)});
  }
  return answer;
}

void Write(const BoxOccupancy& answer, v1::GetBoxOccupancyResponse* proto) {
  Write(static_cast<const Versioned&>(answer), proto->mutable_scene());
  proto->set_cell_m(answer.cell_m);
  Write(answer.origin_W, proto->mutable_origin_m());
  for (std::uint32_t count : answer.cell_counts) proto->add_cell_counts(count);
  for (const BoxOccupancy::Counts& counts : answer.counts) {
    proto->add_free(counts.free);
    proto->add_unknown_space(counts.unknown_space);
    proto->add_beyond_horizon(counts.beyond_horizon);
    proto->add_occupied(counts.occupied);
    proto->add_out_of_bounds(counts.out_of_bounds);
  }
  for (SpaceStatus status : answer.cells) proto->add_cells(ToProto(status));
}

absl::StatusOr<BoxOccupancy> ReadBoxOccupancy(const v1::GetBoxOccupancyResponse& proto) {
  const int times = proto.free_size();
  if (proto.cell_counts_size() != 3 || proto.unknown_space_size() != times ||
      proto.beyond_horizon_size() != times || proto.occupied_size() != times ||
      proto.out_of_bounds_size() != times) {
    return Misfit();
  }
  BoxOccupancy answer;
  static_cast<Versioned&>(answer) = ReadVersion(proto.scene());
  answer.cell_m = proto.cell_m();
  answer.origin_W = {proto.origin_m().x(), proto.origin_m().y(), proto.origin_m().z()};
  std::copy(proto.cell_counts().begin(), proto.cell_counts().end(), answer.cell_counts.begin());
  for (int i = 0; i < times; ++i) {
    answer.counts.push_back({proto.free(i), proto.unknown_space(i), proto.beyond_horizon(i),
                             proto.occupied(i), proto.out_of_bounds(i)});
  }
  answer.cells = ReadStatuses(proto.cells());
  return answer;
}

void Write(const SliceOccupancy& answer, v1::GetSliceOccupancyResponse* proto) {
  Write(static_cast<const Versioned&>(answer), proto->mutable_scene());
  proto->set_cell_m(answer.cell_m);
  proto->set_columns(answer.columns);
  proto->set_rows(answer.rows);
  for (SpaceStatus status : answer.cells) proto->add_cells(ToProto(status));
  proto->mutable_object_ids()->Add(answer.objects.begin(), answer.objects.end());
}

absl::StatusOr<SliceOccupancy> ReadSlice(const v1::GetSliceOccupancyResponse& proto) {
  const std::size_t grid = std::size_t{proto.columns()} * proto.rows();
  const std::size_t size = proto.cells_size();
  if (size != static_cast<std::size_t>(proto.object_ids_size()) || grid == 0 || size % grid != 0) {
    return Misfit();
  }
  SliceOccupancy answer;
  static_cast<Versioned&>(answer) = ReadVersion(proto.scene());
  answer.cell_m = proto.cell_m();
  answer.columns = proto.columns();
  answer.rows = proto.rows();
  answer.cells = ReadStatuses(proto.cells());
  answer.objects.assign(proto.object_ids().begin(), proto.object_ids().end());
  return answer;
}

void Write(const RayAnswers& answer, v1::CastRaysResponse* proto) {
  Write(static_cast<const Versioned&>(answer), proto->mutable_scene());
  for (const RayAnswer& ray : answer.rays) {
    proto->add_first_hit_m(ray.first_hit_m.value_or(kNone));
    proto->add_first_unknown_m(ray.first_unknown_m.value_or(kNone));
    proto->add_object_ids(ray.object);
  }
}

absl::StatusOr<RayAnswers> ReadRays(const v1::CastRaysResponse& proto) {
  const int size = proto.first_hit_m_size();
  if (proto.first_unknown_m_size() != size || proto.object_ids_size() != size) return Misfit();
  RayAnswers answer;
  static_cast<Versioned&>(answer) = ReadVersion(proto.scene());
  for (int i = 0; i < size; ++i) {
    answer.rays.push_back(
        {Value(proto.first_hit_m(i)), Value(proto.first_unknown_m(i)), proto.object_ids(i)});
  }
  return answer;
}

}  // namespace clearway
