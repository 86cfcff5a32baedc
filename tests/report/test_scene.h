// A small scene to draw: a wall on a floor, and one box-shaped object.
#pragma once

#include <memory>

#include "clearway/scene/scene_snapshot.h"

namespace clearway {

inline constexpr double kTestResolutionM = 0.1;

// Occupies the voxels whose centre lies in the box.
inline void FillBox(VoxelMap& map, const Aabb& box, LogOdds value) {
  const VoxelKey low = map.grid().KeyOf(box.min), high = map.grid().KeyOf(box.max);
  for (int x = low.x; x <= high.x; ++x) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int z = low.z; z <= high.z; ++z) {
        if (box.Contains(map.grid().CenterOf({x, y, z}))) map.Set({x, y, z}, value);
      }
    }
  }
}

// An object of the given size at `T_W_O`, turned by `yaw_rad` in O.
inline std::shared_ptr<MovingObject> BoxObject(ObjectId id, const Eigen::Vector3d& size_m,
                                               const Pose& T_W_O, Time stamp) {
  VoxelMap map_O(kTestResolutionM);
  FillBox(map_O, {-0.5 * size_m, 0.5 * size_m}, map_O.model().clamp_max);
  MovingObject object;
  object.id = id;
  object.history = {{stamp, T_W_O}};
  object.first_seen = object.last_seen = stamp;
  object.frames_seen = 1;
  return std::make_shared<MovingObject>(WithMap(std::move(object), std::move(map_O)));
}

// 10 x 10 m: a floor at z in [-1, -0.9] for x < 5; free space above it; a wall of 2 m at x in [2,
// 2.2]; nothing known for x > 5. Object 7, 2 x 1 x 1 m, stands at (-2, 0, 0).
inline SceneSnapshot TestScene() {
  SceneSnapshot scene = SceneSnapshot::Empty(SceneParams{});
  scene.version = 1;
  scene.stamp = Time(FromSeconds(10));
  VoxelMap& map = scene.static_map_W;
  FillBox(map, {{-5, -5, -0.9}, {5, 5, 1}}, map.model().clamp_min);
  FillBox(map, {{-5, -5, -1}, {5, 5, -0.9}}, map.model().clamp_max);
  FillBox(map, {{2, -5, -0.9}, {2.2, 5, 1}}, map.model().clamp_max);
  scene.objects.push_back(BoxObject(7, {2, 1, 1}, Pose::Translation(-2, 0, 0), scene.stamp));
  return scene;
}

}  // namespace clearway
