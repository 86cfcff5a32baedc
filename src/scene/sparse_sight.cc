#include "scene/sparse_sight.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "scene/rays_near.h"

namespace clearway {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

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

// Between neighbours of one degree of azimuth.
std::vector<double> ApartUpwards_rad(std::vector<Direction> directions) {
  std::ranges::sort(directions);
  std::vector<double> apart_rad;
  for (std::size_t i = 1; i < directions.size(); ++i) {
    if (directions[i].azimuth_deg != directions[i - 1].azimuth_deg) continue;
    apart_rad.push_back(directions[i].up_rad - directions[i - 1].up_rad);
  }
  return apart_rad;
}

// That of the lengths up to which, from the shortest on, they are half of them all; 0 if none are.
double HalfOfAll(std::vector<double> lengths) {
  std::ranges::sort(lengths);
  const double all = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  double sum = 0;
  for (const double length : lengths) {
    sum += length;
    if (2 * sum >= all) return length;
  }
  return 0;
}

}  // namespace

BeamsApart BeamsApartAt(const MovingObject& object, const LabelledCloud& cloud, Time stamp,
                        const SceneParams& params) {
  if (cloud.origins_W.empty()) return {};
  const Pose T_W_O = PredictPose(object, stamp, params.horizon).T_W_O;
  const ClippedRays rays = RaysWithin(object.observed_box_O, T_W_O, cloud, params);
  const double rad = HalfOfAll(ApartUpwards_rad(DirectionsOf(rays)));
  const Eigen::Vector3d sensor_W = cloud.origins_W.front().cast<double>();
  return {rad, rad * (T_W_O * object.observed_box_O.Center() - sensor_W).norm()};
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
