#include "scene/sparse_sight.h"

#include <cstdint>
#include <numbers>
#include <set>

namespace clearway {
namespace {

constexpr double kWideApart_rad = 0.5 * std::numbers::pi / 180;

std::set<std::int32_t> HeightsHit(const VoxelMap& map_O) {
  std::set<std::int32_t> heights;
  map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) { heights.insert(VoxelAt(block_key, index).z); });
  });
  return heights;
}

}  // namespace

double ShareMissedBetweenBeams(const MovingObject& object, const Eigen::Vector3d& sensor_W) {
  const std::set<std::int32_t> hit = HeightsHit(object.map_O);
  if (hit.empty()) return 0;
  const auto layers = static_cast<double>(*hit.rbegin() - *hit.begin() + 1);
  const auto layers_hit = static_cast<double>(hit.size());
  const Eigen::Vector3d center_W = object.history.back().T_W_O * object.observed_box_O.Center();
  const double apart_m = layers / layers_hit * object.map_O.grid().resolution_m();
  const bool wide_apart = apart_m > kWideApart_rad * (center_W - sensor_W).norm();
  return wide_apart ? 1 - layers_hit / layers : 0;
}

}  // namespace clearway
