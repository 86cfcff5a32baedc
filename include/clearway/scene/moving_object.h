// One object's map in its own frame, and where that frame is at any time.
#pragma once

#include <algorithm>
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

// The velocity of the constant screw from one pose to a later one. Zero for an object that stands
// still, up to rounding. Of more than kMaxTurn_rad nobody knows the direction: then the translation
// alone counts.
Twist VelocityBetween(const StampedPose& before, const StampedPose& after);

// The poses after `t_k`.
std::vector<StampedPose> FutureAfter(const std::vector<StampedPose>& future, Time t_k);

// Along which axis an object is completed by what no ray has met of it (SolidMode::kCompletedHull):
// by the mirror image of what was seen, at the upright plane that halves its width; and, as long as
// it was seen from one end alone, by how long a vehicle is taken to be at least.
struct Completion {
  double yaw_rad = 0;  // of its length in O, about O's z: the way it goes
  // What went fast, and was only seen from behind, goes on ahead of what was seen (1); only seen
  // from before, behind it (-1). 0: not known to be longer than seen.
  int unseen_end = 0;
  // The sensor was so far beside or above it that rays could tell where it ends.
  bool length_seen = false;
  bool operator==(const Completion&) const = default;
};

// The part of space that an object fills, in O: the convex hull of its occupied voxels, completed
// or not, or the shape of a given object. Immutable.
struct Solid {
  Shape shape;                       // convex
  std::shared_ptr<const Mesh> hull;  // around the shape (see HullAround); never null, empty if no
                                     // voxel is occupied
  Aabb box_O;                        // around the occupied voxels or the hull
  double radius_m = 0;               // of the smallest ball about O's origin that holds the hull
};
std::shared_ptr<const Solid> SolidOf(const VoxelMap& map_O,
                                     const std::optional<Completion>& completion = {});
std::shared_ptr<const Solid> SolidOf(const Shape& shape);

// How far from where it is predicted an object's centre (that of its solid's box) is at most, in 95
// of 100 cases: at_m + speed_mps h + accel_mps2 h^2 / 2, h seconds after its last pose. None of
// the three is below 0, so that it never shrinks.
// None exceeds kMaxBoundTerm: see Saturated.
struct PositionBound {
  double at_m = 0, speed_mps = 0, accel_mps2 = 0;

  // 0 before the last pose.
  double At(double seconds) const {
    return seconds < 0 ? 0 : at_m + seconds * (speed_mps + 0.5 * seconds * accel_mps2);
  }
  // In m/s.
  double Rate(double seconds) const { return speed_mps + seconds * accel_mps2; }
  bool operator==(const PositionBound&) const = default;
};

// No term of a bound is larger: nothing is that far off, and products with times stay finite.
inline constexpr double kMaxBoundTerm = 1e6;
// The bound with larger terms cut to that.
PositionBound Saturated(const PositionBound& bound);

// Where an object's newest pose comes from.
enum class PoseSource {
  kFirstSight = 0,  // no motion is known yet
  kReported = 1,    // a frame's motion or pose
  kEstimated = 2,   // registration of its points (SceneParams::motion_from_points)
  kBridged = 3,     // prediction: its points came without a motion or pose
};

// What a source whose poses are off (SceneParams::object_pose_error_m) says of an object.
struct ToldPose {
  Time stamp;
  // T is O where the source's poses, or its motions one after the other, carry it by themselves.
  Pose T_W_T;
  Pose T_T_O;     // by how much they were off, evened out over the last views
  int views = 0;  // of the object that this is taken from
};

// How the points of the last frame that showed an object lay, in O; each voxel with points counts
// once. Of an object whose motion may have to be estimated.
struct LastView {
  Time stamp;
  Eigen::Vector3d centroid_O = Eigen::Vector3d::Zero();
  Aabb box_O;
};

// By how much objects are grown at a time to come.
struct ObjectGrowth {
  double mps = 0;             // times the seconds since their t_k
  double bound_multiple = 0;  // times their PositionBound
};

// A moving object as of one scene version. Immutable once published; any thread may read it.
struct MovingObject {
  ObjectId id = 0;
  // Others under which it was seen again after it had been lost (SceneParams::reidentify), the
  // newest last. They name it as well.
  std::vector<ObjectId> also;
  // When a frame last named it by each of its ids but the newest, so as many as `also`. After the
  // object lifetime a frame that uses that id means another object by it.
  std::vector<Time> older_ids_told;
  // The object that it is a part of (Frame::parts); kStaticLabel: of none.
  ObjectId part_of = kStaticLabel;
  VoxelMap map_O{0.1};  // hits in O
  // Of a given object, which was told and not seen (see given_object.h): in O, never a
  // TriangleMesh. Null for a reconstructed one.
  std::shared_ptr<const Shape> given_shape;
  // None but with SolidMode::kCompletedHull, and then as soon as it is known which way it goes.
  std::optional<Completion> completion;
  // Both follow from map_O and completion (see WithMap) or given_shape.
  std::shared_ptr<const Solid> solid;
  Aabb observed_box_O;

  // Poses by ascending stamp; never empty. The last one, at t_k, is what predictions start from.
  std::vector<StampedPose> history;
  // Poses to come, as somebody stated them, by ascending stamp, all after t_k; they count instead
  // of the last motion.
  std::vector<StampedPose> future;
  // How it goes on after them: of their last interval, as they were stated (see WithFuture). Zero
  // without a future.
  Twist future_velocity_O;
  // Constant body-frame velocity of its motion (rad/s, m/s at O's origin), of the last one or of
  // its track (MotionModel), or that of the whole that it is a part of; none while no motion is
  // known.
  std::optional<Twist> velocity_O;
  // Of its predictions, from the last pose that is known or stated on: what is stated is taken as
  // it is. Of a given object none, as long as no frame moves it.
  PositionBound bound;
  // The poses of the history from then on came from frames; among earlier ones are predictions.
  Time tracked_since;
  // Stamp of the newest pose that is not a prediction, nor an estimate if any was reported.
  Time placed_at;
  // Whether the last pose was estimated from points; whether a frame ever gave a motion or pose.
  bool estimated = false, reported = false;
  // T_B_O of a source that gives poses, fixed when it first did.
  std::optional<Pose> T_B_O;
  // For whoever applies frames alone: mirrors do not have them, and they count for no comparison.
  std::optional<ToldPose> told;
  std::optional<LastView> last_view;
  // While it is bridged: the box of its voxels when it was last placed by more than a prediction,
  // and of later views of more of it. Points are compared with it. If they were compared with all
  // voxels, each frame could add a little to what the one before added.
  std::optional<Aabb> placed_box_O;

  Time first_seen;
  Time last_seen;  // last frame with points of it
  std::int64_t frames_seen = 0;
  bool bridged = false;  // the last pose is a prediction: points came without a motion

  Time t_k() const { return history.back().stamp; }
  bool IsCalled(ObjectId name) const {
    return name == id || std::find(also.begin(), also.end(), name) != also.end();
  }
  std::vector<ObjectId> Ids() const;  // all that name it, the oldest first
  PoseSource pose_source() const {
    if (bridged) return PoseSource::kBridged;
    if (estimated) return PoseSource::kEstimated;
    return reported ? PoseSource::kReported : PoseSource::kFirstSight;
  }
  bool given() const { return given_shape != nullptr; }
  // Whether its solid's shape counts as occupied: its voxels alone may (SolidMode), if it has any.
  bool FillsSolid(SolidMode mode) const { return given() || mode != SolidMode::kVoxels; }

  // No motion and no future known, or none but rounding.
  bool AtRest() const;
  double SpeedMps() const;  // as it sets out from t_k

  // The last pose that is known or stated: from here on it is extrapolated.
  const StampedPose& LastPose() const { return future.empty() ? history.back() : future.back(); }
  // The velocity of that, zero at rest.
  Twist LastVelocity() const {
    return future.empty() ? velocity_O.value_or(Twist{}) : future_velocity_O;
  }
  // The two poses in turn, known or stated, between which `t` lies: before->stamp <= t <
  // after->stamp. `t` must lie between the first of them all and the last.
  struct Interval {
    const StampedPose* before;
    const StampedPose* after;
  };
  Interval IntervalAt(Time t) const;
};

// The object with another map, its solid and box made to fit.
MovingObject WithMap(MovingObject object, VoxelMap map_O);
// The object with another future, and the velocity that follows from it; its first interval begins
// at the object's newest pose.
MovingObject WithFuture(MovingObject object, std::vector<StampedPose> future);

// Where an object is at a time.
struct PredictedPose {
  Pose T_W_O;
  // Set beyond the horizon, which counts from the last pose: T_W_O is then the pose at the
  // horizon's end, and the object may be anywhere in the ball of this radius about its origin (the
  // swept bound: the solid's radius grown by the speed since).
  std::optional<double> beyond_horizon_radius_m;
};

// T_W_O(t) (II-E): after t_k its motion continued as a constant screw, before it the history
// interpolated, before the history its first pose. An object at rest stays at its last pose for
// ever. Where a future is stated, it is interpolated likewise, then its last interval continued,
// and the horizon counts from its end.
PredictedPose PredictPose(const MovingObject& object, Time t, Duration horizon);

}  // namespace clearway
