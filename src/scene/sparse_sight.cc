#include "scene/sparse_sight.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include "scene/rays_near.h"

namespace clearway {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr double kWideApart_rad = 0.6 * kDegree_rad;

struct Direction {
  int azimuth_deg;
  double up_rad;
  auto operator<=>(const Direction&) const = default;
};

std::vector<Direction> DirectionsOf(const ClippedRays& rays) {
  constexpr float kShortest_m = 1e-3F;  // of shorter ones the direction is lost by rounding
  std::vector<Direction> directions;
  for (std::size_t i = 0; i < rays.ends_O.size(); ++i) {
    const Eigen::Vector3f way = rays.ends_O[i] - rays.origins_O[i];
    if (way.norm() < kShortest_m) continue;
    const double azimuth_rad = std::atan2(way.y(), way.x());
    directions.push_back({static_cast<int>(std::floor(azimuth_rad / kDegree_rad)),
                          std::atan2(way.z(), way.head<2>().norm())});
  }
  return directions;
}

bool AreWideApart(std::vector<Direction> directions) {
  std::ranges::sort(directions);
  double all_rad = 0, wide_rad = 0;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (directions[i].azimuth_deg != directions[i - 1].azimuth_deg) continue;
    const double apart_rad = directions[i].up_rad - directions[i - 1].up_rad;
    all_rad += apart_rad;
    if (apart_rad > kWideApart_rad) wide_rad += apart_rad;
  }
  return 2 * wide_rad > all_rad;
}

}  // namespace

bool IsSeenSparsely(const MovingObject& object, const LabelledCloud& cloud, Time stamp,
                    const SceneParams& params) {
  const Pose T_W_O = PredictPose(object, stamp, params.horizon).T_W_O;
  return AreWideApart(DirectionsOf(RaysWithin(object.observed_box_O, T_W_O, cloud, params)));
}

double ShareOfHeightsMissed(const MovingObject& object) {
  std::set<std::int32_t> hit;
  object.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) { hit.insert(VoxelAt(block_key, index).z); });
  });
  if (hit.empty()) return 0;
  const double heights = *hit.rbegin() - *hit.begin() + 1;
  return 1 - static_cast<double>(hit.size()) / heights;
}

}  // namespace clearway
