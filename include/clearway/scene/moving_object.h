// One object's map in its own frame, and where that frame is at any time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "clearway/base/time.h"
#include "clearway/geometry/pose.h"
#include "clearway/geometry/shape.h"
#include "clearway/map/voxel_map.h"
#include "clearway/scene/frame.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

struct StampedPose {
  Time stamp;
  Pose T_W_O;
  bool operator==(const StampedPose&) const = default;
};

// The part of space that an object fills, in O: the convex hull of its occupied voxels. Immutable.
struct Solid {
  std::shared_ptr<const Mesh> hull;  // never null; empty if no voxel is occupied
  Aabb box_O;                        // around the occupied voxels
  double radius_m = 0;               // of the smallest ball about O's origin that holds the hull
};
std::shared_ptr<const Solid> SolidOf(const VoxelMap& map_O);

// A moving object as of one scene version. Immutable once published; any thread may read it.
struct MovingObject {
  ObjectId id = 0;
  VoxelMap map_O{0.1};  // hits in O
  // Both follow from map_O (see WithMap).
  std::shared_ptr<const Solid> solid;
  Aabb observed_box_O;

  // Poses by ascending stamp; never empty. The last one, at t_k, is what predictions start from.
  std::vector<StampedPose> history;
  // Constant body-frame velocity of the last motion (rad/s, m/s at O's origin); none while no
  // motion is known.
  std::optional<Twist> velocity_O;
  // T_B_O of a source that gives poses, fixed when it first did.
  std::optional<Pose> T_B_O;

  Time first_seen;
  Time last_seen;  // last frame with points of it
  std::int64_t frames_seen = 0;
  bool bridged = false;  // the last pose is a prediction: points came without a motion

  Time t_k() const { return history.back().stamp; }
  bool AtRest() const;  // no motion known, or none but rounding
  double SpeedMps() const { return velocity_O ? velocity_O->linear.norm() : 0.0; }
};

// The object with another map, its solid and box made to fit.
MovingObject WithMap(MovingObject object, VoxelMap map_O);

// Where an object is at a time.
struct PredictedPose {
  Pose T_W_O;
  // Set beyond t_k + horizon: T_W_O is then the pose at the horizon's end, and the object may be
  // anywhere in the ball of this radius about its origin (the swept bound: the solid's radius grown
  // by the speed since).
  std::optional<double> beyond_horizon_radius_m;
};

// T_W_O(t) (II-E): after t_k the last motion continued as a constant screw, before it the history
// interpolated, before the history its first pose. An object at rest stays at its last pose for
// ever.
PredictedPose PredictPose(const MovingObject& object, Time t, Duration horizon);

}  // namespace clearway
