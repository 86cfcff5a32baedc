#include "clearway/report/object_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clearway/geometry/distance.h"
#include "clearway/map/voxel_neighbours.h"

namespace clearway {
namespace {

bool IsCovered(const VoxelMap& map_O, const Eigen::Vector3d& p_O) {
  const VoxelGrid& grid = map_O.grid();
  return std::ranges::any_of(WithNeighbours(grid.KeyOf(p_O)), [&](VoxelKey key) {
    return map_O.State(key) == VoxelState::kOccupied &&
           PointBoxDistance(p_O, grid.BoxOf(key)) <= 0.5 * grid.resolution_m();
  });
}

}  // namespace

double ObjectFit::Quantile_m(double share) const {
  if (errors_m.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<double>(errors_m.size() - 1);
  return errors_m[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * last))];
}

double ObjectFit::Completeness() const {
  return met == 0 ? std::numeric_limits<double>::quiet_NaN()
                  : static_cast<double>(covered) / static_cast<double>(met);
}

ObjectFit& ObjectFit::operator+=(const ObjectFit& other) {
  voxel_m = other.voxel_m;
  const auto middle = static_cast<std::ptrdiff_t>(errors_m.size());
  errors_m.insert(errors_m.end(), other.errors_m.begin(), other.errors_m.end());
  std::inplace_merge(errors_m.begin(), errors_m.begin() + middle, errors_m.end());
  met += other.met;
  covered += other.covered;
  return *this;
}

SceneFit Together(const std::map<ObjectId, ObjectFit>& fits) {
  SceneFit scene;
  for (const auto& [id, fit] : fits) {
    scene.together += fit;
    scene.worst_accuracy_voxels =
        std::max(scene.worst_accuracy_voxels, fit.Accuracy_m() / fit.voxel_m);
    scene.worst_completeness = std::min(scene.worst_completeness, fit.Completeness());
  }
  return scene;
}

void ObjectFitter::Add(const SceneSnapshot& scene, const Pose& T_R_W) {
  for (const auto& object : scene.objects) {
    if (object->last_seen != scene.stamp || !bodies_.Find(object->id)) continue;
    const auto T_W_B = bodies_.T_W_B(object->id, scene.stamp);
    if (!T_W_B) continue;
    Seen& seen = seen_[object->id];
    if (seen.object != nullptr && seen.object->first_seen != object->first_seen) seen = {};
    seen.object = object;
    seen.growth.push_back(object->map_O.occupied_count());
    if (!object->bridged) {
      seen.T_O_B.Add(Inverse(object->history.back().T_W_O) * T_R_W * *T_W_B);
    }
  }
}

std::map<ObjectId, ObjectFit> ObjectFitter::Fits(const MetSurfaces& met) const {
  std::map<ObjectId, ObjectFit> fits;
  for (const auto& [id, seen] : seen_) {
    if (!seen.T_O_B.Empty()) fits[id] = FitOf(seen, met.Of(id));
  }
  return fits;
}

ObjectFit ObjectFitter::FitOf(const Seen& seen, const MetSurfaces::Pieces& met_B) const {
  const Body& body = *bodies_.Find(seen.object->id);
  const VoxelMap& map_O = seen.object->map_O;
  const Pose T_O_B = seen.T_O_B.Value(), T_B_O = Inverse(T_O_B);
  ObjectFit fit;
  fit.voxel_m = map_O.grid().resolution_m();
  fit.growth = seen.growth;
  map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const Eigen::Vector3d center_O = map_O.grid().CenterOf(VoxelAt(block_key, index));
      fit.errors_m.push_back(SurfaceDistance(T_B_O * center_O, body));
    });
  });
  std::ranges::sort(fit.errors_m);
  fit.met = met_B.size();
  for (const auto& [key, p_B] : met_B) fit.covered += IsCovered(map_O, T_O_B * p_B);
  return fit;
}

}  // namespace clearway
