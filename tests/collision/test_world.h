// Small scenes and robots for tests, made without frames.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "clearway/collision/state_checker.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// A scene under construction. Stamps start at kTestStart.
inline constexpr Time kTestStart = TimeFromNanoseconds(1'000'000'000'000);

inline Time TestTime(double seconds_after_start) {
  return kTestStart + FromSeconds(seconds_after_start);
}

class TestWorld {
 public:
  explicit TestWorld(SceneParams params = {}) : scene_(SceneSnapshot::Empty(params)) {
    scene_.version = 7;
    scene_.stamp = kTestStart;
  }

  // All voxels whose centre lies in the box.
  TestWorld& Free(const Aabb& box_W) { return Fill(box_W, -2000); }
  TestWorld& Occupied(const Aabb& box_W) { return Fill(box_W, 4000); }
  TestWorld& Unknown(const Aabb& box_W) {
    scene_.static_map_W.Forget(box_W);
    return *this;
  }

  // An object last seen at TestTime(stamp_s) at T_W_O, its voxels given by keys in O.
  TestWorld& Object(ObjectId id, const std::vector<VoxelKey>& voxels_O, const Pose& T_W_O,
                    std::optional<Twist> velocity_O = {}, double stamp_s = 0) {
    return Object(id, voxels_O, {{TestTime(stamp_s), T_W_O}}, velocity_O);
  }
  TestWorld& Object(ObjectId id, const std::vector<VoxelKey>& voxels_O,
                    std::vector<StampedPose> history, std::optional<Twist> velocity_O = {}) {
    VoxelMap map_O(scene_.params.object_resolution_m, scene_.params.Model());
    for (const VoxelKey& key : voxels_O) map_O.Set(key, 4000);
    MovingObject object;
    object.id = id;
    object.first_seen = history.front().stamp;
    object.last_seen = history.back().stamp;
    object.history = std::move(history);
    object.velocity_O = velocity_O;
    scene_.objects.push_back(
        std::make_shared<const MovingObject>(WithMap(std::move(object), std::move(map_O))));
    return *this;
  }

  // A given one, at T_W_O at TestTime(stamp_s).
  TestWorld& Given(ObjectId id, const Shape& shape, const Pose& T_W_O,
                   std::optional<Twist> velocity_O = {}, std::vector<StampedPose> future = {},
                   double stamp_s = 0) {
    MovingObject object;
    object.id = id;
    object.map_O = VoxelMap(scene_.params.object_resolution_m, scene_.params.Model());
    object.given_shape = std::make_shared<const Shape>(shape);
    object.solid = SolidOf(shape);
    object.first_seen = object.last_seen = TestTime(stamp_s);
    object.history = {{TestTime(stamp_s), T_W_O}};
    object.velocity_O = velocity_O;
    scene_.objects.push_back(
        std::make_shared<const MovingObject>(WithFuture(std::move(object), std::move(future))));
    return *this;
  }
  // Of the object that was added last, as what follows.
  TestWorld& Bound(const PositionBound& bound) {
    MovingObject object = *scene_.objects.back();
    object.bound = bound;
    scene_.objects.back() = std::make_shared<const MovingObject>(std::move(object));
    return *this;
  }
  TestWorld& Also(std::vector<ObjectId> ids) {
    MovingObject object = *scene_.objects.back();
    object.older_ids_told.assign(ids.size(), scene_.stamp);
    object.also = std::move(ids);
    scene_.objects.back() = std::make_shared<const MovingObject>(std::move(object));
    return *this;
  }
  TestWorld& Future(std::vector<StampedPose> future) {
    scene_.objects.back() =
        std::make_shared<const MovingObject>(WithFuture(*scene_.objects.back(), std::move(future)));
    return *this;
  }

  ScenePtr Scene() const { return std::make_shared<const SceneSnapshot>(scene_); }

 private:
  TestWorld& Fill(const Aabb& box_W, LogOdds value) {
    VoxelMap& map = scene_.static_map_W;
    const BlockKey low = BlockOf(map.grid().KeyOf(box_W.min));
    const BlockKey high = BlockOf(map.grid().KeyOf(box_W.max));
    for (BlockKey key = low; key.z <= high.z; ++key.z) {
      for (key.y = low.y; key.y <= high.y; ++key.y) {
        for (key.x = low.x; key.x <= high.x; ++key.x) {
          const VoxelBlock* before = map.blocks().Find(key);
          VoxelBlock block = before == nullptr ? VoxelBlock{} : *before;
          for (int i = 0; i < kVoxelsPerBlock; ++i) {
            const Eigen::Vector3d center = map.grid().CenterOf(VoxelAt(key, i));
            if (box_W.Contains(center)) block.Set(i, value, map.model());
          }
          map.PutBlock(key, block);
        }
      }
    }
    return *this;
  }

  SceneSnapshot scene_;
};

// The keys of a solid block of voxels from `low` (included) to `high` (excluded).
inline std::vector<VoxelKey> VoxelCuboid(VoxelKey low, VoxelKey high) {
  std::vector<VoxelKey> keys;
  for (std::int32_t z = low.z; z < high.z; ++z) {
    for (std::int32_t y = low.y; y < high.y; ++y) {
      for (std::int32_t x = low.x; x < high.x; ++x) keys.push_back({x, y, z});
    }
  }
  return keys;
}

// A cube of 2 * half along each edge as a closed mesh.
inline std::shared_ptr<const Mesh> CubeMesh(double half_m) {
  auto mesh = std::make_shared<Mesh>();
  for (int corner = 0; corner < 8; ++corner) {
    mesh->vertices.emplace_back(corner & 1 ? half_m : -half_m, corner & 2 ? half_m : -half_m,
                                corner & 4 ? half_m : -half_m);
  }
  mesh->triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

// One state of a robot of one link.
inline StateBatch OneState(const Pose& T_W_L, Time time = kTestStart) { return {{time}, {T_W_L}}; }

inline StateBatch At(double x_m, double y_m, double z_m, double seconds_after_start = 0) {
  return OneState(Pose::Translation(x_m, y_m, z_m), TestTime(seconds_after_start));
}

}  // namespace clearway
