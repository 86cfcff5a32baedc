#include "clearway/report/met_surfaces.h"

#include <optional>

namespace clearway {

void MetSurfaces::Add(const Frame& frame, const Pose& T_W_S, const SceneSnapshot& scene) {
  for (const auto& object : scene.objects) {
    if (object->first_seen == frame.stamp) met_.erase(object->id);
  }
  const VoxelGrid static_grid(scene.params.resolution_m);
  const VoxelGrid object_grid(scene.params.object_resolution_m);
  const double range_m = scene.params.rays.max_range_m;
  std::map<ObjectId, std::optional<Pose>> T_B_S;  // none: nowhere
  for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
    const ObjectId id = frame.labels[i];
    const Eigen::Vector3d p_S = frame.points_S[i].cast<double>();
    const bool returned = frame.no_return.empty() || frame.no_return[i] == 0;
    if (id < kStaticLabel || !returned || !p_S.allFinite()) continue;
    if (range_m >= 0 && p_S.norm() > range_m) continue;
    const auto [body, fresh] = T_B_S.try_emplace(id);
    if (fresh) {
      const auto T_W_B =
          id == kStaticLabel ? std::optional(Pose{}) : bodies_.T_W_B(id, frame.stamp);
      if (T_W_B) body->second = Inverse(*T_W_B) * T_W_S;
    }
    if (!body->second) continue;
    const Eigen::Vector3d p_B = *body->second * p_S;
    if (id != kStaticLabel && !bodies_.Find(id)->BoxB().Padded(kBeside_m).Contains(p_B)) continue;
    const VoxelGrid& grid = id == kStaticLabel ? static_grid : object_grid;
    if (grid.Addressable(p_B)) met_[id].try_emplace(grid.KeyOf(p_B), p_B);
  }
}

const MetSurfaces::Pieces& MetSurfaces::Of(ObjectId id) const {
  static const Pieces none;
  const auto found = met_.find(id);
  return found == met_.end() ? none : found->second;
}

}  // namespace clearway
