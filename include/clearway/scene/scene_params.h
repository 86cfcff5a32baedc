// Everything that decides what a scene makes of its frames.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/geometry/aabb.h"
#include "clearway/map/occupancy_model.h"
#include "clearway/map/ray.h"

namespace clearway {

// What of an object counts as occupied.
enum class SolidMode {
  kConvexHull = 0,     // of its occupied voxels
  kVoxels = 1,         // these alone
  kCompletedHull = 2,  // the hull, and what is taken to be there unseen (Completion)
};
// By mode, as settings and flags name them.
inline constexpr std::array<std::string_view, 3> kSolidModeNames = {"convex_hull", "voxels",
                                                                    "completed_hull"};

// How an object is taken to go on after its newest pose.
enum class MotionModel {
  kLastMotion = 0,  // as between its last two poses (II-E)
  kTrack = 1,       // as its poses of about the last second tell, whose noise evens out
};

// For which objects a motion is estimated when a frame gives points of them, but neither a motion
// nor a pose: the points are registered to the object's own map. z of W must point up.
enum class MotionFromPoints {
  kAuto = 0,  // those of which no frame has given a motion or pose, or none for 0.6 s
  kOn = 1,    // all
  kOff = 2,   // none: they are where they are predicted
};
// By mode, as settings and flags name them.
inline constexpr std::array<std::string_view, 3> kMotionFromPointsNames = {"auto", "on", "off"};

// How long an object has to stay where it is before it counts as at rest. Longer than the history,
// it never does.
inline constexpr Duration kRestWindow = std::chrono::seconds(1);

// Parameters of a scene; they travel with it to mirrors and checkpoints. A plain value.
struct SceneParams {
  double resolution_m = 0.1;         // of the static map
  double object_resolution_m = 0.1;  // of the objects' maps
  OccupancyProbabilities occupancy;
  RayOptions rays;

  SolidMode solid = SolidMode::kConvexHull;
  // Whether rays also clear what was hit of an object, where they pass it.
  bool clear_objects_by_rays = false;

  MotionModel motion = MotionModel::kLastMotion;
  MotionFromPoints motion_from_points = MotionFromPoints::kAuto;
  Duration horizon = std::chrono::seconds(5);           // how long a motion is extrapolated
  Duration object_lifetime = std::chrono::seconds(10);  // unseen for longer: dropped
  Duration history = std::chrono::seconds(10);          // how far back poses are kept
  // An object that stayed within this distance for kRestWindow is at rest, whatever its last motion
  // says: that is the noise of SLAM. 0: at rest is only what did not move at all (II-E as printed).
  double rest_distance_m = 0;
  // How far off the source's poses and motions of objects are, on average over frames: metres, and
  // the angle. If one of them is not zero, each view of an object is registered to the object's own
  // map, and the object is where it fits. 0 and 0: objects are where the source says.
  double object_pose_error_m = 0, object_pose_error_rad = 0;
  // The same of the source's poses of the sensor. If one of them is not zero, each scan is
  // registered to the static map, and the sensor is where its static points fit: the scene's world
  // is then one that holds still where the source's drifts, and all that a frame states is carried
  // over (WorldCorrections). 0 and 0: the sensor is where the source says.
  double sensor_pose_error_m = 0, sensor_pose_error_rad = 0;
  // Whether an object that was lost and is seen again under another id is known again, by where it
  // is predicted and by its shape; z of W must point up. It then goes on under its first id, and
  // the other names it too.
  bool reidentify = false;
  // Whether points are doubted whose label those around them in the scan do not bear out: outvoted
  // ones, an object's few that lie apart from the rest of it, and static ones, alone or next to an
  // object's, where one is predicted or turns out to have been. They clear space and hit nothing.
  bool filter_labels = false;

  // Dynamic space: voxels of the static map that were known free for long (their log-odds at the
  // lower clamp) and are hit, a few together and away from surfaces. Something moves there that
  // nobody labelled. They are occupied at once and stay out of the static map for good: free again
  // as soon as a ray passes, unknown when not hit for longer than `dynamic_life`, and static when
  // hit for `dynamic_settle`, with gaps of at most a quarter of it. A life of 0: there is none.
  Duration dynamic_life{};
  Duration dynamic_settle = std::chrono::seconds(2);

  // Rolling window: after each frame the static map forgets the blocks of 8 x 8 x 8 voxels that lie
  // farther than this from the sensor along an axis, so that its memory stays bounded on a drive of
  // any length. Parts of a prior map are forgotten likewise, and a frame from a wrong place forgets
  // all that is far from there. Less than the range of the rays makes blocks only to forget them.
  // 0: nothing is forgotten.
  double keep_distance_m = 0;

  Aabb bounds_W{Eigen::Vector3d::Constant(-1e5), Eigen::Vector3d::Constant(1e5)};
  std::vector<Aabb> keep_out_W;     // these read as occupied by the static map
  std::vector<Aabb> self_filter_S;  // points in here are the robot's own body: left out

  OccupancyModel Model() const { return OccupancyModel(occupancy); }
  // Whether views of objects are registered to their maps, and scans to the static map.
  bool MendsObjectPoses() const { return object_pose_error_m > 0 || object_pose_error_rad > 0; }
  bool MendsSensorPoses() const { return sensor_pose_error_m > 0 || sensor_pose_error_rad > 0; }
  bool operator==(const SceneParams&) const = default;
};

// INVALID_ARGUMENT naming the field, the value and the limit.
absl::Status Validate(const SceneParams& params);

}  // namespace clearway
