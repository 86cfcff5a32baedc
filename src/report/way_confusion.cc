#include "clearway/report/way_confusion.h"

#include <algorithm>
#include <utility>

#include "absl/container/flat_hash_map.h"
#include "clearway/scene/timed_scene.h"
#include "report/box_voxels.h"

namespace clearway {
namespace {

constexpr double kNear_m = 0.3;
constexpr double kMiddle = 0.6;     // of a box's edges
constexpr std::int32_t kEvery = 4;  // voxels along each axis
constexpr Duration kStep = std::chrono::milliseconds(100);

using Ids = absl::InlinedVector<ObjectId, 2>;

// A true box, placed.
struct Placed {
  explicit Placed(const TrueBox& box)
      : id(box.id),
        T_B_W(Inverse(box.T_W_B)),
        box_B{-0.5 * box.size_m, 0.5 * box.size_m},
        middle_B{kMiddle * box_B.min, kMiddle * box_B.max},
        near_B(box_B.Padded(kNear_m)),
        near_W(Transformed(box.T_W_B, near_B)) {}

  ObjectId id;
  Pose T_B_W;
  Aabb box_B, middle_B, near_B, near_W;
};

// What stands there at a time.
class Boxes {
 public:
  Boxes(const Truth& truth, Time t) {
    for (const TrueBox& box : truth.boxes(t)) {
      if (!box.size_m.isZero()) placed_.emplace_back(box);
    }
  }

  // Those in the middle of which it lies.
  Ids Around(const Eigen::Vector3d& p_W) const {
    Ids ids;
    for (const Placed& placed : placed_) {
      if (placed.near_W.Contains(p_W) && placed.middle_B.Contains(placed.T_B_W * p_W)) {
        ids.push_back(placed.id);
      }
    }
    return ids;
  }
  bool AreNear(const Eigen::Vector3d& p_W) const {
    return std::ranges::any_of(placed_, [&](const Placed& placed) {
      return placed.near_W.Contains(p_W) && placed.near_B.Contains(placed.T_B_W * p_W);
    });
  }
  bool KnowAll(const Ids& ids) const {
    return std::ranges::all_of(ids, [&](ObjectId id) {
      return std::ranges::find(placed_, id, &Placed::id) != placed_.end();
    });
  }

  const std::vector<Placed>& placed() const { return placed_; }

 private:
  std::vector<Placed> placed_;
};

// Calls visit(VoxelKey) for the grid's voxels whose centre the box holds, its bottom left out.
template <class Visit>
void ForEachVoxel(const VoxelGrid& grid, const Placed& placed, Visit&& visit) {
  Aabb inner_B = placed.box_B;
  inner_B.min.z() += kNear_m;
  const VoxelKey first = grid.KeyOf(placed.near_W.min), last = grid.KeyOf(placed.near_W.max);
  const auto on_grid = [](std::int32_t i) { return (i + kEvery - 1) & ~(kEvery - 1); };
  VoxelKey key;
  for (key.z = on_grid(first.z); key.z <= last.z; key.z += kEvery) {
    for (key.y = on_grid(first.y); key.y <= last.y; key.y += kEvery) {
      for (key.x = on_grid(first.x); key.x <= last.x; key.x += kEvery) {
        if (inner_B.Contains(placed.T_B_W * grid.CenterOf(key))) visit(key);
      }
    }
  }
}

// A step later, or where boxes are told again: stamps may leave years out.
Time NextLook(const Truth& truth, Time t) {
  constexpr Duration kLongGap = std::chrono::seconds(1);
  const auto next = std::ranges::lower_bound(truth.told, t + kStep);
  const bool leaps = next != truth.told.end() && *next - t > kLongGap;
  return leaps ? *next : t + kStep;
}

Confusion::Said SaidBy(SpaceStatus status) {
  if (status == SpaceStatus::kFree) return Confusion::kFree;
  return status == SpaceStatus::kOccupied ? Confusion::kOccupied : Confusion::kUnknown;
}

// Places of which it is known what is there at a time.
struct KnownPlaces {
  std::vector<Eigen::Vector3d> centers_W;
  std::vector<Ids> ids;  // of the objects that each counts for
  std::vector<bool> occupied;

  void Add(const Eigen::Vector3d& center_W, Ids the_ids, bool is_occupied) {
    centers_W.push_back(center_W);
    ids.push_back(std::move(the_ids));
    occupied.push_back(is_occupied);
  }
};

}  // namespace

WayConfusion::WayConfusion(Truth truth, std::vector<Duration> ahead)
    : truth_(std::move(truth)), ahead_(std::move(ahead)), confusions_(ahead_.size()) {}

void WayConfusion::FindPlaces(const VoxelGrid& grid, Time first) {
  has_places_ = true;
  absl::flat_hash_map<VoxelKey, Ids> passed_by;
  for (Time t = first; t <= truth_.end; t = NextLook(truth_, t)) {
    const Boxes boxes(truth_, t);
    for (const Placed& placed : boxes.placed()) {
      if (!CanLookThrough(grid, placed.near_W)) continue;
      ForEachVoxel(grid, placed, [&](VoxelKey key) {
        Ids& ids = passed_by[key];
        if (std::ranges::find(ids, placed.id) == ids.end()) ids.push_back(placed.id);
      });
    }
  }
  for (auto& [key, ids] : passed_by) places_.push_back({grid.CenterOf(key), std::move(ids)});
}

void WayConfusion::Add(const SceneSnapshot& scene, const Eigen::Vector3d& sensor_W) {
  if (!has_places_) FindPlaces(scene.static_map_W.grid(), scene.stamp);
  for (std::size_t i = 0; i < ahead_.size(); ++i) {
    const Time t = scene.stamp + ahead_[i];
    if (t <= truth_.end) CountAt(i, scene, sensor_W);
  }
}

void WayConfusion::CountAt(std::size_t i, const SceneSnapshot& scene,
                           const Eigen::Vector3d& sensor_W) {
  const Time t = scene.stamp + ahead_[i];
  const Boxes boxes(truth_, t);
  const double range_m = scene.params.rays.max_range_m;
  KnownPlaces known;
  for (const auto& [center_W, passed_by] : places_) {
    if (range_m >= 0 && (center_W - sensor_W).norm() > range_m) continue;
    if (Ids around = boxes.Around(center_W); !around.empty()) {
      known.Add(center_W, std::move(around), true);
    } else if (boxes.KnowAll(passed_by) && !boxes.AreNear(center_W)) {
      known.Add(center_W, passed_by, false);
    }
  }
  const std::size_t size = known.centers_W.size();
  std::vector<PointOccupancy> answers(size);
  TimedScene(scene, t, t).At(known.centers_W, std::vector<Time>(size, t), answers);
  for (std::size_t place = 0; place < size; ++place) {
    const auto truly = known.occupied[place] ? &Confusion::truly_occupied : &Confusion::truly_free;
    const Confusion::Said said = SaidBy(answers[place].status);
    ++(confusions_[i].*truly)[said];
    for (const ObjectId id : known.ids[place]) {
      ++(by_object_.try_emplace(id, ahead_.size()).first->second[i].*truly)[said];
    }
  }
}

}  // namespace clearway
