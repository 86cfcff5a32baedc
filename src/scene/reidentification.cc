#include "scene/reidentification.h"

#include <algorithm>
#include <array>
#include <vector>

#include "scene/object_motion.h"
#include "scene/view_registration.h"

namespace clearway {
namespace {

std::vector<Eigen::Vector3d> OccupiedCenters(const VoxelMap& map) {
  std::vector<Eigen::Vector3d> centers;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach(
        [&](int index) { centers.push_back(map.grid().CenterOf(VoxelAt(key, index))); });
  });
  return centers;
}

// Whether a voxel is occupied that touches the point's.
bool NearOccupied(const VoxelMap& map, const Eigen::Vector3d& p) {
  const VoxelKey at = map.grid().KeyOf(p);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (map.State({at.x + x, at.y + y, at.z + z}) == VoxelState::kOccupied) return true;
      }
    }
  }
  return false;
}

// Whether so many of the points lie where the object was seen before, and hardly any beyond it.
bool Fits(const MovingObject& lost, const std::vector<Eigen::Vector3d>& points_O) {
  constexpr double kOnSurface = 0.6, kWithin = 0.97, kBeyond_voxels = 2;
  const double voxel_m = lost.map_O.grid().resolution_m();
  const Aabb box_O = lost.observed_box_O.Padded(kBeyond_voxels * voxel_m);
  std::size_t within = 0, near = 0;
  for (const Eigen::Vector3d& p_O : points_O) {
    within += box_O.Contains(p_O);
    near += lost.map_O.grid().Addressable(p_O) && NearOccupied(lost.map_O, p_O);
  }
  const auto all = static_cast<double>(points_O.size());
  return static_cast<double>(within) >= kWithin * all &&
         static_cast<double>(near) >= kOnSurface * all;
}

// Of a view from one side two of the three lengths can be told.
bool IsAsLarge(const MovingObject& lost, const std::vector<Eigen::Vector3d>& points_O) {
  constexpr double kLeast = 0.6;
  const double voxel_m = lost.map_O.grid().resolution_m();
  Aabb seen_O;
  for (const Eigen::Vector3d& p_O : points_O) seen_O.Extend(p_O);
  const Eigen::Vector3d seen = seen_O.max - seen_O.min;
  const Eigen::Vector3d known = lost.observed_box_O.max - lost.observed_box_O.min;
  std::array<double, 3> shares{};
  for (int i = 0; i < 3; ++i) shares[i] = (seen[i] + voxel_m) / std::max(known[i], voxel_m);
  std::ranges::sort(shares);
  return shares[1] >= kLeast;
}

Eigen::Vector3d VelocityOfCenter(const MovingObject& object, const Pose& T_W_O) {
  const Twist& twist_O = *object.velocity_O;
  const Eigen::Vector3d center_O = object.observed_box_O.Center();
  return T_W_O.rotation * (twist_O.linear + twist_O.angular.cross(center_O));
}

bool GoesAlike(const MovingObject& lost, const Pose& T_W_L, const MovingObject& young) {
  if (!lost.velocity_O || !young.velocity_O || young.history.size() < 2) return true;
  constexpr double kAlways_mps = 1, kOfSpeed = 0.3;
  const Eigen::Vector3d before_mps = VelocityOfCenter(lost, T_W_L);
  const Eigen::Vector3d now_mps = VelocityOfCenter(young, young.history.back().T_W_O);
  return (now_mps - before_mps).norm() <= kAlways_mps + kOfSpeed * before_mps.norm();
}

}  // namespace

std::optional<Pose> SeenAgainAt(const MovingObject& lost, const MovingObject& young, Time stamp,
                                const SceneParams& params) {
  constexpr std::size_t kFewest = 20;  // voxels
  constexpr double kMostGone_rad_per_s = 0.2, kLeast_rad = 0.05, kLeast_m = 0.05;
  const PredictedPose predicted = PredictPose(lost, stamp, params.horizon);
  if (predicted.beyond_horizon_radius_m) return std::nullopt;
  std::vector<Eigen::Vector3d> points_W = OccupiedCenters(young.map_O);
  if (points_W.size() < kFewest) return std::nullopt;
  for (Eigen::Vector3d& p : points_W) p = young.history.back().T_W_O * p;
  const double unseen_s = ToSeconds(stamp - lost.LastPose().stamp);
  const double bound_m = std::max(lost.bound.At(unseen_s), kLeast_m);
  const Pose T_W_L =
      RegisterView(lost.map_O, points_W,
                   std::array{PoseGuess{predicted.T_W_O, bound_m / 2,
                                        kLeast_rad + kMostGone_rad_per_s * unseen_s}});
  const Eigen::Vector3d center_O = lost.observed_box_O.Center();
  if ((T_W_L * center_O - predicted.T_W_O * center_O).norm() > bound_m) return std::nullopt;
  std::vector<Eigen::Vector3d> points_O = std::move(points_W);
  const Pose T_L_W = Inverse(T_W_L);
  for (Eigen::Vector3d& p : points_O) p = T_L_W * p;
  const bool same =
      Fits(lost, points_O) && IsAsLarge(lost, points_O) && GoesAlike(lost, T_W_L, young);
  return same ? std::optional(T_W_L) : std::nullopt;
}

MovingObject Joined(MovingObject lost, const MovingObject& young, const Pose& T_W_O, Time stamp,
                    const SceneParams& params, ThreadPool& pool) {
  const Pose T_Y_L = Inverse(young.history.back().T_W_O) * T_W_O;
  const Pose T_L_Y = Inverse(T_Y_L);
  ScanUpdate update;
  for (const Eigen::Vector3d& p_Y : OccupiedCenters(young.map_O)) {
    const Eigen::Vector3d p_L = T_L_Y * p_Y;
    if (lost.map_O.grid().Addressable(p_L)) update.MarkHit(lost.map_O.grid().KeyOf(p_L));
  }
  VoxelMap map_O = lost.map_O;
  map_O.Update(update, pool);

  const Time since = young.history.front().stamp;
  for (const StampedPose& pose : young.history) {
    if (pose.stamp > lost.t_k()) lost.history.push_back({pose.stamp, pose.T_W_O * T_Y_L});
  }
  std::erase_if(lost.history,
                [&](const StampedPose& p) { return p.stamp < stamp - params.history; });
  if (young.velocity_O) {
    // The same screw, as L sees it.
    const Pose ahead = T_L_Y * Exp(*young.velocity_O) * T_Y_L;
    lost.velocity_O = Log(ahead);
  }
  if (young.T_B_O) lost.T_B_O = *young.T_B_O * T_Y_L;
  lost.future.clear();
  lost.future_velocity_O = {};
  lost.tracked_since = since;
  lost.bridged = young.bridged;
  lost.last_seen = young.last_seen;
  lost.frames_seen += young.frames_seen;
  lost = WithMap(std::move(lost), std::move(map_O));
  lost.bound = BoundOf(lost.history, since, lost.velocity_O.value_or(Twist{}), *lost.solid, params);
  return lost;
}

}  // namespace clearway
