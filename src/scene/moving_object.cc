#include "clearway/scene/moving_object.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "clearway/geometry/hull.h"

namespace clearway {
namespace {

// The occupied voxels' corners that a convex hull can have: the ends of each row along x. Integer
// coordinates, so that the hull is computed on exact numbers.
std::vector<Eigen::Vector3d> HullCandidates(const VoxelMap& map) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, std::int32_t>> rows;
  map.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      const auto [row, fresh] = rows.try_emplace({key.y, key.z}, key.x, key.x);
      row->second.first = std::min(row->second.first, key.x);
      row->second.second = std::max(row->second.second, key.x);
    });
  });
  std::set<std::tuple<std::int32_t, std::int32_t, std::int32_t>> corners;
  for (const auto& [yz, x_ends] : rows) {
    for (int corner = 0; corner < 4; ++corner) {
      const std::int32_t y = yz.first + (corner & 1), z = yz.second + (corner >> 1);
      corners.emplace(x_ends.first, y, z);
      corners.emplace(x_ends.second + 1, y, z);
    }
  }
  std::vector<Eigen::Vector3d> points;
  points.reserve(corners.size());
  for (const auto& [x, y, z] : corners) points.emplace_back(x, y, z);
  return points;
}

}  // namespace

std::shared_ptr<const Solid> SolidOf(const VoxelMap& map_O) {
  auto solid = std::make_shared<Solid>();
  Mesh hull = ConvexHullOf(HullCandidates(map_O));
  for (Eigen::Vector3d& vertex : hull.vertices) {
    vertex *= map_O.grid().resolution_m();
    solid->box_O.Extend(vertex);
    solid->radius_m = std::max(solid->radius_m, vertex.norm());
  }
  solid->hull = std::make_shared<const Mesh>(std::move(hull));
  return solid;
}

MovingObject WithMap(MovingObject object, VoxelMap map_O) {
  object.solid = SolidOf(map_O);
  object.observed_box_O = map_O.ObservedBox();
  object.map_O = std::move(map_O);
  return object;
}

bool MovingObject::AtRest() const { return !velocity_O.has_value() || *velocity_O == Twist{}; }

PredictedPose PredictPose(const MovingObject& object, Time t, Duration horizon) {
  const std::vector<StampedPose>& history = object.history;
  if (t <= history.front().stamp) return {history.front().T_W_O, {}};
  const StampedPose& last = history.back();
  if (t < last.stamp) {
    const auto after = std::upper_bound(history.begin(), history.end(), t,
                                        [](Time a, const StampedPose& b) { return a < b.stamp; });
    const auto before = after - 1;
    const double fraction = ToSeconds(t - before->stamp) / ToSeconds(after->stamp - before->stamp);
    return {Interpolate(before->T_W_O, after->T_W_O, fraction), {}};
  }
  if (t == last.stamp || object.AtRest()) return {last.T_W_O, {}};
  const Duration ahead = std::min(t - last.stamp, horizon);
  const Pose T_W_O = last.T_W_O * Exp(ToSeconds(ahead) * *object.velocity_O);
  const Duration beyond = t - last.stamp - ahead;
  if (beyond == Duration::zero()) return {T_W_O, {}};
  return {T_W_O, object.solid->radius_m + object.SpeedMps() * ToSeconds(beyond)};
}

}  // namespace clearway
