#include "clearway/io/flatten_scene.h"

#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/scene/timed_scene.h"

namespace clearway {
namespace {

// Around everything whose place is known; what may be anywhere in a swept bound counts where it was
// last placed.
Aabb KnownBox(const SceneAtTime& scene) {
  Aabb box = scene.scene().static_map_W.ObservedBox();
  for (const SceneAtTime::Placed& placed : scene.objects()) {
    box.Extend(placed.beyond_horizon_radius_m
                   ? Transformed(placed.T_W_O, placed.object->solid->box_O)
                   : placed.box_W);
  }
  const double limit_m = scene.scene().static_map_W.grid().limit_m();
  box = Intersection(box, scene.scene().params.bounds_W);
  return Intersection(box,
                      {Eigen::Vector3d::Constant(-limit_m), Eigen::Vector3d::Constant(limit_m)});
}

// The boxes in which something else than the static map may block.
std::vector<Aabb> BoxesToSearch(const SceneAtTime& scene) {
  const Aabb known_W = KnownBox(scene);
  std::vector<Aabb> boxes;
  const auto add = [&](const Aabb& box_W) {
    const Aabb part = Intersection(box_W, known_W);
    if (!part.Empty()) boxes.push_back(part);
  };
  for (const SceneAtTime::Placed& placed : scene.objects()) add(placed.box_W);
  for (const Aabb& box_W : scene.scene().params.keep_out_W) add(box_W);
  return boxes;
}

void Block(VoxelMap& map, VoxelKey key) {
  if (map.State(key) != VoxelState::kOccupied) map.Set(key, map.model().clamp_max);
}

constexpr std::int32_t kVoxelsPerLook = 64;

void BlockInBox(TimedScene& scene, Time time, VoxelKey first, VoxelKey last,
                const std::function<bool()>& cancelled, VoxelMap& map) {
  for (std::int32_t z = first.z; z <= last.z; ++z) {
    for (std::int32_t y = first.y; y <= last.y; ++y) {
      for (std::int32_t x = first.x; x <= last.x; ++x) {
        if ((x - first.x) % kVoxelsPerLook == 0 && cancelled()) return;
        const SpaceStatus status = scene.At(map.grid().CenterOf({x, y, z}), time).status;
        if (status == SpaceStatus::kOccupied || status == SpaceStatus::kBeyondHorizon) {
          Block(map, {x, y, z});
        }
      }
    }
  }
}

// The voxels that a given object may touch.
void BlockShapeOf(const SceneAtTime& scene, const SceneAtTime::Placed& placed,
                  const std::function<bool()>& cancelled, VoxelMap& map) {
  const VoxelGrid& grid = map.grid();
  const double half_diagonal_m = 0.5 * std::sqrt(3.0) * grid.resolution_m();
  const Aabb box_W = Intersection(placed.box_W, KnownBox(scene));
  if (box_W.Empty()) return;
  const VoxelKey first = grid.KeyOf(box_W.min), last = grid.KeyOf(box_W.max);
  for (VoxelKey key = first; key.z <= last.z; ++key.z) {
    for (key.y = first.y; key.y <= last.y; ++key.y) {
      if (cancelled()) return;
      for (key.x = first.x; key.x <= last.x; ++key.x) {
        const Eigen::Vector3d p_O = placed.T_O_W * grid.CenterOf(key);
        if (NearHull(*placed.object->solid->hull, p_O, half_diagonal_m)) Block(map, key);
      }
    }
  }
}

// An object thinner than a voxel can lie between the voxels' centres.
void BlockVoxelsOf(const SceneAtTime& scene, const SceneAtTime::Placed& placed,
                   const std::function<bool()>& cancelled, VoxelMap& map) {
  if (placed.beyond_horizon_radius_m) return;
  if (placed.object->given()) return BlockShapeOf(scene, placed, cancelled, map);
  const VoxelMap& map_O = placed.object->map_O;
  map_O.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const Eigen::Vector3d p_W = placed.T_W_O * map_O.grid().CenterOf(VoxelAt(key, index));
      if (!scene.scene().params.bounds_W.Contains(p_W) || !map.grid().Addressable(p_W)) return;
      Block(map, map.grid().KeyOf(p_W));
    });
  });
}

}  // namespace

absl::StatusOr<VoxelMap> FlattenScene(const SceneAtTime& scene, std::int64_t max_voxels,
                                      const std::function<bool()>& cancelled) {
  VoxelMap map = scene.scene().static_map_W;
  const std::vector<Aabb> boxes = BoxesToSearch(scene);
  double voxels = 0;
  for (const Aabb& box : boxes) {
    voxels += (box.Size().array() / map.grid().resolution_m() + 1).prod();
  }
  if (voxels > static_cast<double>(max_voxels)) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the objects' boxes and keep-out zones hold about ", voxels,
                     " voxels; the limit is ", max_voxels));
  }
  TimedScene timed(scene.scene(), scene.time(), scene.time());
  for (const Aabb& box : boxes) {
    BlockInBox(timed, scene.time(), map.grid().KeyOf(box.min), map.grid().KeyOf(box.max), cancelled,
               map);
    if (cancelled()) return absl::CancelledError("the export was cancelled");
  }
  for (const SceneAtTime::Placed& placed : scene.objects()) {
    BlockVoxelsOf(scene, placed, cancelled, map);
  }
  if (cancelled()) return absl::CancelledError("the export was cancelled");
  return map;
}

}  // namespace clearway
