#include "scene/passed_through.h"

#include <algorithm>
#include <vector>

#include "scene/rays_near.h"

namespace clearway {
namespace {

// Whether the part of the ray meets an occupied voxel.
bool Meets(const VoxelMap& map_O, const Eigen::Vector3f& from_O, const Eigen::Vector3f& to_O) {
  const auto is_occupied = [&](const VoxelKey& key) {
    return map_O.State(key) == VoxelState::kOccupied;
  };
  if (is_occupied(map_O.grid().KeyOf(to_O.cast<double>()))) return true;
  bool meets = false;
  WalkRay(map_O.grid(), from_O, to_O, [&](const VoxelKey& key) {
    meets = is_occupied(key);
    return !meets;
  });
  return meets;
}

}  // namespace

bool IsPassedThrough(const MovingObject& object, const Pose& T_W_O, const LabelledCloud& cloud,
                     const SceneParams& params) {
  constexpr int kFewRays = 5;
  constexpr double kMost = 0.8;
  const ClippedRays rays = RaysWithin(object.observed_box_O, T_W_O, cloud, params);
  const std::vector<ObjectId> ids = object.Ids();
  int meeting = 0, speaking_against = 0;
  for (std::size_t i = 0; i < rays.ends_O.size(); ++i) {
    if (!Meets(object.map_O, rays.origins_O[i], rays.ends_O[i])) continue;
    ++meeting;
    const ObjectId label = cloud.labels[rays.of[i]];
    const bool ends_on_another = label > kStaticLabel && std::ranges::find(ids, label) == ids.end();
    speaking_against += rays.kinds[i] == RayEnd::kClear || ends_on_another;
  }
  return meeting >= kFewRays && speaking_against >= kMost * meeting;
}

}  // namespace clearway
