#include "scene/sensor_registration.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "absl/container/flat_hash_set.h"
#include "scene/registration.h"

namespace clearway {
namespace {

// The points that are looked at lie apart: each tells as much as it does alone.
constexpr RegistrationWeights kWeights = {.trust = 1, .least_step = 1e-4, .guess_sigmas = 5};

// Whether the point is one of a static surface that the map holds.
bool IsStatic(const Frame& frame, std::size_t i, double reach_m, const SceneParams& params) {
  if (frame.labels[i] != kStaticLabel) return false;
  if (!frame.no_return.empty() && frame.no_return[i] != 0) return false;
  const Eigen::Vector3d p_S = frame.points_S[i].cast<double>();
  if (!(p_S.norm() <= reach_m)) return false;  // of what is not finite, too
  return std::ranges::none_of(params.self_filter_S,
                              [&](const Aabb& box_S) { return box_S.Contains(p_S); });
}

// Static points of the scan, in S: at most one of each cube of so many voxels, so that what is near
// and dense does not outweigh what is far.
std::vector<Eigen::Vector3d> OneOfEachCube(const Frame& frame, int voxels,
                                           const SceneParams& params) {
  constexpr std::size_t kLookedAt = 40'000;
  const VoxelGrid cubes_S(voxels * params.resolution_m);
  const double limit_m = VoxelGrid(params.resolution_m).limit_m(),
               range_m = params.rays.max_range_m;
  const double reach_m = range_m > 0 ? std::min(range_m, limit_m) : limit_m;
  const std::size_t step = frame.points_S.size() / kLookedAt + 1;
  absl::flat_hash_set<VoxelKey> taken;
  std::vector<Eigen::Vector3d> points_S;
  for (std::size_t i = 0; i < frame.points_S.size(); i += step) {
    if (!IsStatic(frame, i, reach_m, params)) continue;
    const Eigen::Vector3d p_S = frame.points_S[i].cast<double>();
    if (taken.insert(cubes_S.KeyOf(p_S)).second) points_S.push_back(p_S);
  }
  return points_S;
}

// Of cubes of a block's size; of smaller ones where the scan shows so little that they would be
// few. Of these again some evenly.
std::vector<Eigen::Vector3d> SpreadPoints(const Frame& frame, const SceneParams& params) {
  constexpr std::size_t kMost = 1'500, kEnough = 200;
  std::vector<Eigen::Vector3d> points_S;
  for (int voxels = kBlockSize; voxels >= 1 && points_S.size() < kEnough; voxels /= 2) {
    points_S = OneOfEachCube(frame, voxels, params);
  }
  const std::size_t all = points_S.size(), few = std::min(all, kMost);
  for (std::size_t i = 0; i < few; ++i) points_S[i] = points_S[i * all / few];
  points_S.resize(few);
  return points_S;
}

// A guess of T_W_S, and how far it may be off along and about each axis.
struct SensorGuess {
  Pose T_W_S;
  double sigma_m, sigma_rad;
};

// The source's pose; and where the source says that the sensor has gone since the correction
// before. Its poses are off by what changes slowly, so that it knows the way better than the place.
std::vector<SensorGuess> GuessesOf(const Frame& frame_V, const WorldCorrections& before,
                                   const SceneParams& params) {
  constexpr double kMeanOverSigma = 1.6;  // of the norm of three, over the sigma of one
  constexpr double kLeast = 1e-3;
  constexpr double kForgotten_s = 10;  // in so long errors become others
  const auto guess = [&](const Pose& T_W_S, double share) {
    return SensorGuess{T_W_S, std::max(share * params.sensor_pose_error_m / kMeanOverSigma, kLeast),
                       std::max(share * params.sensor_pose_error_rad / kMeanOverSigma, kLeast)};
  };
  const Pose T_V_S{frame_V.T_W_S.rotation.normalized(), frame_V.T_W_S.translation};
  std::vector<SensorGuess> guesses = {guess(T_V_S, 1)};
  if (before.Empty()) return guesses;
  const double passed_s = ToSeconds(frame_V.stamp - before.NewestStamp());
  const double changed = std::sqrt(2 * (1 - std::exp(-passed_s / kForgotten_s)));
  guesses.push_back(guess(before.At(frame_V.stamp) * T_V_S, changed));
  return guesses;
}

// The map about the sensor. M has W's axes and lies at about the sensor: then turns and shifts are
// not mixed up far from W's origin.
class MapAround {
 public:
  MapAround(const VoxelMap& static_map_W, const Eigen::Vector3d& sensor_W)
      : T_W_M_{Eigen::Quaterniond::Identity(), sensor_W},
        moments_(static_map_W),
        coarse_(moments_, SurfaceCells::Size::kBlock, sensor_W),
        fine_(moments_, SurfaceCells::Size::kOctant, sensor_W) {}

  std::size_t CountNear(std::span<const Eigen::Vector3d> points_S, const Pose& T_W_S) {
    const Pose T_M_S = Inverse(T_W_M_) * T_W_S;
    std::size_t near = 0;
    for (const Eigen::Vector3d& p_S : points_S) near += coarse_.At(T_M_S * p_S) != nullptr;
    return near;
  }

  // T_W_S.
  Pose Register(std::span<const Eigen::Vector3d> points_S, std::span<const SensorGuess> guesses) {
    std::vector<PoseGuess> guesses_S;
    for (const SensorGuess& guess : guesses) {
      guesses_S.push_back({Inverse(guess.T_W_S) * T_W_M_, guess.sigma_m, guess.sigma_rad});
    }
    const RegistrationStage stages[] = {{coarse_, 4, 6}, {coarse_, 2, 6}, {fine_, 2, 8}};
    return T_W_M_ * Inverse(Registration(points_S, guesses_S, kWeights).Register(stages));
  }

 private:
  Pose T_W_M_;
  BlockMoments moments_;
  SurfaceCells coarse_, fine_;
};

}  // namespace

Pose RegisterWorld(const Frame& frame_V, const VoxelMap& static_map_W,
                   const WorldCorrections& before, const SceneParams& params) {
  constexpr std::size_t kFewest = 50;  // points near the map
  std::vector<Eigen::Vector3d> points_S = SpreadPoints(frame_V, params);
  const std::vector<SensorGuess> guesses = GuessesOf(frame_V, before, params);
  MapAround map(static_map_W, guesses.back().T_W_S.translation);
  const bool any_fits = std::ranges::any_of(guesses, [&](const SensorGuess& guess) {
    return map.CountNear(points_S, guess.T_W_S) >= kFewest;
  });
  if (!any_fits) {
    if (before.Empty()) return {};
    points_S.clear();
  }
  const Pose T_V_S{frame_V.T_W_S.rotation.normalized(), frame_V.T_W_S.translation};
  return map.Register(points_S, guesses) * Inverse(T_V_S);
}

}  // namespace clearway
