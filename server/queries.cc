#include "server/queries.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/scene/timed_scene.h"
#include "wire/status.h"

namespace clearway {
namespace {

// Between two looks at whether the client has gone: a fraction of a millisecond, and some 5 ms if
// there are as many keep-out zones as can be.
constexpr std::size_t kPointsPerLook = 512;  // fewer together are looked up more slowly
constexpr std::size_t kPosesPerLook = 256;

absl::Status GoneError() { return absl::CancelledError("the client has gone"); }

// The earliest and the latest; there must be one.
TimedScene Timed(const SceneSnapshot& scene, std::span<const Time> times) {
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  return {scene, *first, *last};
}

// Asks for points point_of(0), ... at time_of(0), ... until the client has gone; calls
// take(i, PointOccupancy) for each in turn.
template <class PointOf, class TimeOf, class Take>
absl::Status ForEachPoint(TimedScene& scene, std::size_t count, const Gone& gone,
                          PointOf&& point_of, TimeOf&& time_of, Take&& take) {
  std::array<Eigen::Vector3d, kPointsPerLook> points_W;
  std::array<Time, kPointsPerLook> times;
  std::array<PointOccupancy, kPointsPerLook> answers;
  for (std::size_t begin = 0; begin < count; begin += kPointsPerLook) {
    if (gone()) return GoneError();
    const std::size_t size = std::min(kPointsPerLook, count - begin);
    for (std::size_t i = 0; i < size; ++i) {
      points_W[i] = point_of(begin + i);
      times[i] = time_of(begin + i);
    }
    scene.At({points_W.data(), size}, {times.data(), size}, {answers.data(), size});
    for (std::size_t i = 0; i < size; ++i) take(begin + i, answers[i]);
  }
  return absl::OkStatus();
}

// Voxel indices along one axis whose voxels the interval touches.
struct CellRange {
  double first = 0;
  double count = 0;  // a double: it may be absurdly large
};
CellRange CellsTouching(double min_m, double max_m, double cell_m) {
  const double first = std::floor(min_m / cell_m);
  return {first, std::max(1.0, std::ceil(max_m / cell_m) - first)};
}

void Count(SpaceStatus status, BoxOccupancy::Counts& counts) {
  switch (status) {
    case SpaceStatus::kFree:
      ++counts.free;
      return;
    case SpaceStatus::kUnknownSpace:
      ++counts.unknown_space;
      return;
    case SpaceStatus::kBeyondHorizon:
      ++counts.beyond_horizon;
      return;
    case SpaceStatus::kOutOfBounds:
      ++counts.out_of_bounds;
      return;
    case SpaceStatus::kOccupied:
    case SpaceStatus::kUnresolved:
      ++counts.occupied;
      return;
  }
}

// About how many voxels rays pass that hit nothing.
double VoxelsAlong(const VoxelGrid& grid, std::span<const Eigen::Vector3f> directions_W,
                   double max_range_m) {
  // No way through the grid is longer than its diagonal.
  const double range_m = std::min(max_range_m, 2 * std::sqrt(3.0) * grid.limit_m());
  double steps_m = 0;
  for (const Eigen::Vector3f& direction_W : directions_W) {
    steps_m += range_m * direction_W.cast<double>().normalized().cwiseAbs().sum();
  }
  return steps_m / grid.resolution_m() + static_cast<double>(directions_W.size());
}

absl::Status TooManyCells(const std::string& field, double cells, std::uint64_t limit) {
  return absl::ResourceExhaustedError(
      absl::StrCat(field, ": asks for ", cells, " cells; the limit is ", limit));
}

}  // namespace

Aabb BoxAroundBlocks(const VoxelMap& map) {
  Aabb box;
  const double block_m = kBlockSize * map.grid().resolution_m();
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock&) {
    const Eigen::Vector3d low = block_m * Eigen::Vector3d(key.x, key.y, key.z);
    box.Extend(low);
    box.Extend(low + Eigen::Vector3d::Constant(block_m));
  });
  return box;
}

absl::Status AskPoints(const SceneSnapshot& scene, Eigen::Map<const Eigen::Matrix3Xf> points_W,
                       std::span<const std::int64_t> times_ns, const Gone& gone,
                       const std::function<void(std::size_t, const PointOccupancy&)>& answer) {
  if (points_W.cols() == 0) return absl::OkStatus();
  const auto [first, last] = std::minmax_element(times_ns.begin(), times_ns.end());
  TimedScene timed(scene, TimeFromNanoseconds(*first), TimeFromNanoseconds(*last));
  return ForEachPoint(
      timed, static_cast<std::size_t>(points_W.cols()), gone,
      [&](std::size_t i) { return points_W.col(static_cast<Eigen::Index>(i)).cast<double>(); },
      [&](std::size_t i) { return TimeFromNanoseconds(times_ns[times_ns.size() == 1 ? 0 : i]); },
      answer);
}

absl::StatusOr<BoxOccupancy> AskBox(const SceneSnapshot& scene, const Aabb& box_W,
                                    std::span<const Time> times, bool include_cells,
                                    std::uint64_t max_cells, const Gone& gone) {
  BoxOccupancy answer{{scene.version, scene.stamp}, scene.params.resolution_m, {}, {}, {}, {}};
  CellRange range[3];
  double cells = static_cast<double>(times.size());
  for (int i = 0; i < 3; ++i) {
    range[i] = CellsTouching(box_W.min[i], box_W.max[i], answer.cell_m);
    cells *= range[i].count;
  }
  if (!(cells <= static_cast<double>(max_cells))) {
    return TooManyCells("box_world", cells, max_cells);
  }
  std::size_t per_time = 1;
  for (int i = 0; i < 3; ++i) {
    answer.origin_W[i] = range[i].first * answer.cell_m;
    answer.cell_counts[i] = static_cast<std::uint32_t>(range[i].count);
    per_time *= answer.cell_counts[i];
  }
  const std::uint32_t nx = answer.cell_counts[0], ny = answer.cell_counts[1];
  const auto center_of = [&](std::size_t i) -> Eigen::Vector3d {
    const std::size_t at = i % per_time;
    const Eigen::Vector3d cell(at % nx + range[0].first, at / nx % ny + range[1].first,
                               at / nx / ny + range[2].first);
    return (cell.array() + 0.5) * answer.cell_m;
  };
  answer.counts.resize(times.size());
  TimedScene timed = Timed(scene, times);
  const absl::Status status = ForEachPoint(
      timed, per_time * times.size(), gone, center_of,
      [&](std::size_t i) { return times[i / per_time]; },
      [&](std::size_t i, const PointOccupancy& point) {
        Count(point.status, answer.counts[i / per_time]);
        if (include_cells) answer.cells.push_back(point.status);
      });
  if (!status.ok()) return status;
  return answer;
}

absl::StatusOr<SliceOccupancy> AskSlice(const SceneSnapshot& scene, const SliceQuestion& slice,
                                        std::span<const Time> times, std::uint64_t max_cells,
                                        const Gone& gone) {
  SliceOccupancy answer{{scene.version, scene.stamp}, 0, 0, 0, {}, {}};
  answer.cell_m = slice.cell_m.value_or(scene.params.resolution_m);
  const Eigen::Vector2d counts =
      ((slice.max_W - slice.min_W) / answer.cell_m).array().ceil().max(1.0);
  const double cells = counts.prod() * static_cast<double>(times.size());
  if (!(cells <= static_cast<double>(max_cells))) return TooManyCells("cell_m", cells, max_cells);
  answer.columns = static_cast<std::uint32_t>(counts.x());
  answer.rows = static_cast<std::uint32_t>(counts.y());
  const std::size_t per_time = std::size_t{answer.columns} * answer.rows;
  const auto center_of = [&](std::size_t i) -> Eigen::Vector3d {
    const std::size_t at = i % per_time;
    const Eigen::Vector2d cell(at % answer.columns + 0.5, at / answer.columns + 0.5);
    const Eigen::Vector2d p = slice.min_W + answer.cell_m * cell;
    return {p.x(), p.y(), slice.z_m};
  };
  TimedScene timed = Timed(scene, times);
  const absl::Status status = ForEachPoint(
      timed, per_time * times.size(), gone, center_of,
      [&](std::size_t i) { return times[i / per_time]; },
      [&](std::size_t, const PointOccupancy& point) {
        answer.cells.push_back(point.status);
        answer.objects.push_back(point.object);
      });
  if (!status.ok()) return status;
  return answer;
}

absl::StatusOr<RayAnswers> AskRays(const SceneSnapshot& scene,
                                   std::span<const Eigen::Vector3f> origins_W,
                                   std::span<const Eigen::Vector3f> directions_W,
                                   std::span<const Time> times, double max_range_m,
                                   std::uint64_t max_voxels, const Gone& gone) {
  RayAnswers answer{{scene.version, scene.stamp}, {}};
  if (origins_W.empty()) return answer;
  const double voxels = VoxelsAlong(scene.static_map_W.grid(), directions_W, max_range_m);
  if (!(voxels <= static_cast<double>(max_voxels))) {
    return absl::ResourceExhaustedError(absl::StrCat("max_range_m: the rays pass up to ", voxels,
                                                     " voxels; the limit is ", max_voxels));
  }
  TimedScene timed = Timed(scene, times);
  for (std::size_t i = 0; i < origins_W.size(); ++i) {
    const Time time = times[times.size() == 1 ? 0 : i];
    answer.rays.push_back(timed.CastRay(origins_W[i].cast<double>(), directions_W[i].cast<double>(),
                                        max_range_m, time, gone));
    if (gone()) return GoneError();
  }
  return answer;
}

absl::StatusOr<PredictedPoses> AskPoses(const SceneSnapshot& scene, std::span<const ObjectId> ids,
                                        std::span<const Time> times, std::uint64_t max_poses,
                                        const Gone& gone) {
  PredictedPoses answer{{scene.version, scene.stamp}, {ids.begin(), ids.end()}, {}};
  if (ids.empty()) {
    for (const auto& object : scene.objects) answer.objects.push_back(object->id);
  }
  if (answer.objects.size() * times.size() > max_poses) {
    return LimitError("times_ns", answer.objects.size() * times.size(), max_poses);
  }
  for (ObjectId id : answer.objects) {
    const MovingObject* object = scene.FindObject(id);
    if (object == nullptr) {
      return WithReason(absl::NotFoundError(absl::StrCat("object_ids: version ", scene.version,
                                                         " has no object ", id)),
                        "UNKNOWN_OBJECT");
    }
    for (Time time : times) {
      if (answer.poses.size() % kPosesPerLook == 0 && gone()) return GoneError();
      answer.poses.push_back(PredictPose(*object, time, scene.params.horizon));
    }
  }
  return answer;
}

}  // namespace clearway
