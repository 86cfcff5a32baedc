#include "scene/reidentification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "clearway/map/voxel_neighbours.h"
#include "scene/completion.h"
#include "scene/occupied_centers.h"
#include "scene/position_bound.h"
#include "scene/same_object.h"
#include "scene/view_registration.h"

namespace clearway {
namespace {

// Whether so many of the points lie where the object was seen before, and hardly any beyond it:
// fewer yet where poses are off, as such maps are wide enough for much.
bool Fits(const MovingObject& lost, const std::vector<Eigen::Vector3d>& points_O,
          const SceneParams& params) {
  constexpr double kOnSurface = 0.5;
  const double kWithin = params.object_pose_error_m > 0 ? 0.99 : 0.97;
  const double voxel_m = lost.map_O.grid().resolution_m();
  const Aabb box_O = lost.observed_box_O.Padded(kReachesBeyond_voxels * voxel_m);
  std::size_t within = 0, near = 0;
  for (const Eigen::Vector3d& p_O : points_O) {
    within += box_O.Contains(p_O);
    near += NearOccupied(lost.map_O, p_O);
  }
  const auto all = static_cast<double>(points_O.size());
  return static_cast<double>(within) >= kWithin * all &&
         static_cast<double>(near) >= kOnSurface * all;
}

// Of a view from one side two of the three lengths can be told, and the height nearly always: as it
// stands in its own frame, for registering it may tilt it.
bool IsAsLarge(const MovingObject& lost, const MovingObject& young,
               const std::vector<Eigen::Vector3d>& points_O) {
  constexpr double kLeast = 0.6, kLeastUp = 0.75;
  const double voxel_m = lost.map_O.grid().resolution_m();
  Aabb seen_O;
  for (const Eigen::Vector3d& p_O : points_O) seen_O.Extend(p_O);
  const Eigen::Vector3d seen = seen_O.max - seen_O.min;
  const Eigen::Vector3d known = lost.observed_box_O.max - lost.observed_box_O.min;
  std::array<double, 3> shares{};
  for (int i = 0; i < 3; ++i) shares[i] = (seen[i] + voxel_m) / std::max(known[i], voxel_m);
  const double height_m = young.observed_box_O.max.z() - young.observed_box_O.min.z();
  const double up = (height_m + voxel_m) / std::max(known.z(), voxel_m);
  std::ranges::sort(shares);
  return shares[1] >= kLeast && up >= kLeastUp;
}

bool GoesAlike(const MovingObject& lost, const Pose& T_W_L, const MovingObject& young,
               double unseen_s) {
  const auto before_mps = VelocityAt_mps(lost, T_W_L), now_mps = VelocityNow_mps(young);
  return before_mps && now_mps && MayComeToGo(*before_mps, *now_mps, unseen_s);
}

// For less than what velocities are told by: whoever passes where it was to be could be it.
bool WasGlimpsed(const MovingObject& lost) {
  constexpr Duration kLongest = std::chrono::milliseconds(800);
  return lost.last_seen - lost.first_seen < kLongest;
}

// None if poses, and with them velocities (of about a second), are off by so much that another one
// like it could be there. That one cannot be nearer to it than its width, nor does what goes slowly
// get far; after a long way one could be.
std::optional<double> Tolerance_m(const MovingObject& lost, double unseen_s,
                                  const SceneParams& params) {
  const double beside_m = ToleranceOfPlace_m(lost, 0, unseen_s);
  if (params.object_pose_error_m * std::max(1.0, unseen_s) > beside_m) return std::nullopt;
  return ToleranceOfPlace_m(lost, lost.SpeedMps(), unseen_s);
}

// Whether they are so near each other that registering them is worth its time.
bool MayTouch(const MovingObject& lost, const Pose& T_W_L, const MovingObject& young,
              const Pose& T_W_Y, double apart_m) {
  const Aabb lost_W = Transformed(T_W_L, lost.observed_box_O).Padded(apart_m);
  return lost_W.Intersects(Transformed(T_W_Y, young.observed_box_O));
}

// The guess, mended so that the points, given in Y, fit.
Pose Registered(const MovingObject& lost, const std::vector<Eigen::Vector3d>& points_Y,
                const Pose& T_Y_L, double sigma_m, double unseen_s) {
  constexpr double kTurns_radps = 0.05, kLeast_rad = 0.03;
  const PoseGuess guess{T_Y_L, sigma_m, kLeast_rad + kTurns_radps * unseen_s};
  return RegisterView(lost.map_O, points_Y, std::array{guess});
}

// The velocity of L's origin and its turn, of a body that moves so in the frame Y of its own.
Twist SeenFrom(const Pose& T_Y_L, const Twist& velocity_Y) {
  const Eigen::Quaterniond R_L_Y = T_Y_L.rotation.conjugate();
  return {R_L_Y * velocity_Y.angular,
          R_L_Y * (velocity_Y.linear + velocity_Y.angular.cross(T_Y_L.translation))};
}

VoxelMap WithVoxelsOf(VoxelMap map_L, const VoxelMap& map_Y, const Pose& T_Y_L, ThreadPool& pool) {
  const Pose T_L_Y = Inverse(T_Y_L);
  ScanUpdate update;
  for (const Eigen::Vector3d& p_Y : OccupiedCenters(map_Y)) {
    const Eigen::Vector3d p_L = T_L_Y * p_Y;
    if (map_L.grid().Addressable(p_L)) update.MarkHit(map_L.grid().KeyOf(p_L));
  }
  map_L.Update(update, pool);
  return map_L;
}

// With the poses known of `young`, and those stated for it: they are newer.
MovingObject GoneOnAs(MovingObject lost, const MovingObject& young, const Pose& T_Y_L, Time stamp,
                      const SceneParams& params) {
  for (const StampedPose& pose : young.history) {
    if (pose.stamp > lost.t_k()) lost.history.push_back({pose.stamp, pose.T_W_O * T_Y_L});
  }
  const Time oldest = lost.t_k() - params.history;
  std::erase_if(lost.history, [&](const StampedPose& p) { return p.stamp < oldest; });
  if (young.velocity_O) lost.velocity_O = SeenFrom(T_Y_L, *young.velocity_O);
  if (!young.future.empty()) {
    lost.future = young.future;
    for (StampedPose& pose : lost.future) pose.T_W_O = pose.T_W_O * T_Y_L;
    lost.future_velocity_O = SeenFrom(T_Y_L, young.future_velocity_O);
  }
  lost.future = FutureAfter(lost.future, stamp);
  if (lost.future.empty()) lost.future_velocity_O = {};
  lost.tracked_since = young.tracked_since;
  lost.bridged = young.bridged;
  lost.placed_at = young.placed_at;
  lost.estimated = young.estimated;
  lost.reported |= young.reported;
  lost.last_view.reset();
  return lost;
}

// Things stay on the ground; lifted a little, one shape fits another.
double HeightTolerance_m(double unseen_s, const SceneParams& params) {
  constexpr double kVoxels = 1.5, kDrift_mps = 0.05;
  return kVoxels * params.object_resolution_m + kDrift_mps * unseen_s + params.object_pose_error_m;
}

// In W, of the middle of the lost one, from where it was to be to where it is with L at T_Y_L.
Eigen::Vector3d MovedBy_m(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                          const PlaceIfSame& place) {
  const Eigen::Vector3d center_L = lost.observed_box_O.Center();
  return FirstPose(young).T_W_O * (T_Y_L * center_L) - place.T_W_L * center_L;
}

}  // namespace

bool IsToBeJoined(const MovingObject& object, Time stamp) {
  if (object.given() || !IsYoung(object, stamp)) return false;
  const bool glimpsed = object.last_seen - object.first_seen < kFirstGlimpse;
  return glimpsed == (stamp - object.last_seen > kOutOfSight);
}

double MayBeDoubted(const MovingObject& object) {
  constexpr double kOfGlimpse = 0.3, kAtLast = 0.9;
  const Duration looked = object.last_seen - object.first_seen;
  const double more_s = std::max(0.0, ToSeconds(looked - kFirstGlimpse));
  return std::lerp(kOfGlimpse, kAtLast, more_s / ToSeconds(kYoung - kFirstGlimpse));
}

std::optional<PlaceIfSame> PlaceToBeSeenAgain(const MovingObject& lost, const MovingObject& young,
                                              const SceneParams& params) {
  if (WasGlimpsed(lost)) return std::nullopt;
  const StampedPose& first = FirstPose(young);
  const PredictedPose predicted = PredictPose(lost, first.stamp, params.horizon);
  if (predicted.beyond_horizon_radius_m) return std::nullopt;
  const double unseen_s = ToSeconds(first.stamp - lost.t_k());
  const std::optional<double> tolerance_m = Tolerance_m(lost, unseen_s, params);
  if (!tolerance_m || !MayTouch(lost, predicted.T_W_O, young, first.T_W_O, *tolerance_m)) {
    return std::nullopt;
  }
  return PlaceIfSame{predicted.T_W_O, *tolerance_m, HeightTolerance_m(unseen_s, params)};
}

std::optional<Pose> SeenAgain(const MovingObject& lost, const MovingObject& young,
                              const SceneParams& params) {
  constexpr std::int64_t kFewest = 20;  // voxels
  if (young.map_O.occupied_count() < kFewest) return std::nullopt;
  const std::optional<PlaceIfSame> place = PlaceToBeSeenAgain(lost, young, params);
  if (!place) return std::nullopt;
  const StampedPose& first = FirstPose(young);
  const double unseen_s = ToSeconds(first.stamp - lost.t_k());
  if (!GoesAlike(lost, place->T_W_L, young, unseen_s)) return std::nullopt;

  const std::vector<Eigen::Vector3d> points_Y = OccupiedCenters(young.map_O);
  const Pose T_Y_predicted = Inverse(first.T_W_O) * place->T_W_L;
  const Pose T_Y_L = Registered(lost, points_Y, T_Y_predicted, place->tolerance_m / 2, unseen_s);
  if (!FitsThere(lost, young, T_Y_L, params)) return std::nullopt;
  return T_Y_L;
}

double HeightOff(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                 const SceneParams& params) {
  const std::optional<PlaceIfSame> place = PlaceToBeSeenAgain(lost, young, params);
  if (!place) return std::numeric_limits<double>::infinity();
  return std::abs(MovedBy_m(lost, young, T_Y_L, *place).z()) / place->height_tolerance_m;
}

bool FitsThere(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
               const SceneParams& params) {
  const std::optional<PlaceIfSame> place = PlaceToBeSeenAgain(lost, young, params);
  if (!place) return false;
  if (MovedBy_m(lost, young, T_Y_L, *place).norm() > place->tolerance_m) return false;
  if (HeightOff(lost, young, T_Y_L, params) > 1) return false;
  std::vector<Eigen::Vector3d> points_L = OccupiedCenters(young.map_O);
  const Pose T_L_Y = Inverse(T_Y_L);
  for (Eigen::Vector3d& p : points_L) p = T_L_Y * p;
  return Fits(lost, points_L, params) && IsAsLarge(lost, young, points_L);
}

MovingObject Joined(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                    Time stamp, const SceneParams& params, ThreadPool& pool) {
  MovingObject joined = GoneOnAs(lost, young, T_Y_L, stamp, params);
  if (young.T_B_O) joined.T_B_O = *young.T_B_O * T_Y_L;
  joined.told = young.told;
  if (joined.told) joined.told->T_T_O = joined.told->T_T_O * T_Y_L;
  joined.last_seen = young.last_seen;
  joined.frames_seen += young.frames_seen;
  joined.also.push_back(young.id);
  joined.also.insert(joined.also.end(), young.also.begin(), young.also.end());
  joined.older_ids_told.push_back(lost.t_k());
  joined.older_ids_told.insert(joined.older_ids_told.end(), young.older_ids_told.begin(),
                               young.older_ids_told.end());
  joined.completion = JoinedCompletion(lost.completion, young.completion, T_Y_L);
  joined = WithMap(std::move(joined), WithVoxelsOf(lost.map_O, young.map_O, T_Y_L, pool));
  joined.bound = BoundOf(joined.history, joined.tracked_since, joined.velocity_O.value_or(Twist{}),
                         *joined.solid, params);
  return joined;
}

}  // namespace clearway
