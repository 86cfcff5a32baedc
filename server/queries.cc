#include "server/queries.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "absl/strings/str_cat.h"
#include "clearway/scene/timed_scene.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::size_t kItemsPerLook = 1024;  // between two looks at whether the client has gone

// Calls ask(i) for each item, until the client has gone.
template <class Ask>
absl::Status ForEachItem(std::size_t items, const Gone& gone, Ask&& ask) {
  for (std::size_t i = 0; i < items; ++i) {
    if (i % kItemsPerLook == 0 && gone()) return absl::CancelledError("the client has gone");
    ask(i);
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
  std::vector<Eigen::Vector3d> points;
  std::vector<Time> times;
  std::vector<PointOccupancy> answers;
  const auto count = static_cast<std::size_t>(points_W.cols());
  for (std::size_t begin = 0; begin < count; begin += kItemsPerLook) {
    if (gone()) return absl::CancelledError("the client has gone");
    const std::size_t size = std::min(kItemsPerLook, count - begin);
    points.resize(size);
    times.resize(size);
    answers.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      points[i] = points_W.col(begin + i).cast<double>();
      times[i] = TimeFromNanoseconds(times_ns[times_ns.size() == 1 ? 0 : begin + i]);
    }
    timed.At(points, times, answers);
    for (std::size_t i = 0; i < size; ++i) answer(begin + i, answers[i]);
  }
  return absl::OkStatus();
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
  const auto [nx, ny, nz] = answer.cell_counts;
  for (Time time : times) {
    const SceneAtTime at(scene, time);
    BoxOccupancy::Counts& counts = answer.counts.emplace_back();
    const auto ask = [&](std::size_t i) {
      const Eigen::Vector3d cell(i % nx + range[0].first, i / nx % ny + range[1].first,
                                 i / nx / ny + range[2].first);
      const SpaceStatus status = at.At((cell.array() + 0.5) * answer.cell_m).status;
      Count(status, counts);
      if (include_cells) answer.cells.push_back(status);
    };
    if (auto status = ForEachItem(per_time, gone, ask); !status.ok()) return status;
  }
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
  for (Time time : times) {
    const SceneAtTime at(scene, time);
    const auto ask = [&](std::size_t i) {
      const Eigen::Vector2d cell(i % answer.columns + 0.5, i / answer.columns + 0.5);
      const Eigen::Vector2d p = slice.min_W + answer.cell_m * cell;
      const PointOccupancy point = at.At({p.x(), p.y(), slice.z_m});
      answer.cells.push_back(point.status);
      answer.objects.push_back(point.object);
    };
    const std::size_t per_time = std::size_t{answer.columns} * answer.rows;
    if (auto status = ForEachItem(per_time, gone, ask); !status.ok()) return status;
  }
  return answer;
}

absl::StatusOr<RayAnswers> AskRays(const SceneSnapshot& scene,
                                   std::span<const Eigen::Vector3f> origins_W,
                                   std::span<const Eigen::Vector3f> directions_W,
                                   std::span<const Time> times, double max_range_m,
                                   const Gone& gone) {
  RayAnswers answer{{scene.version, scene.stamp}, {}};
  std::optional<SceneAtTime> placed;  // at the last ray's time
  for (std::size_t i = 0; i < origins_W.size(); ++i) {
    if (gone()) return absl::CancelledError("the client has gone");
    const Time time = times[times.size() == 1 ? 0 : i];
    if (!placed || placed->time() != time) placed.emplace(scene, time);
    answer.rays.push_back(CastQueryRay(*placed, origins_W[i].cast<double>(),
                                       directions_W[i].cast<double>(), max_range_m));
  }
  return answer;
}

absl::StatusOr<PredictedPoses> AskPoses(const SceneSnapshot& scene, std::span<const ObjectId> ids,
                                        std::span<const Time> times, std::uint64_t max_poses) {
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
      answer.poses.push_back(PredictPose(*object, time, scene.params.horizon));
    }
  }
  return answer;
}

}  // namespace clearway
