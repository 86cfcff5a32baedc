#include "clearway/scene/object_extent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "clearway/geometry/polygon.h"

namespace clearway {
namespace {

// Slower than this, a direction of motion is noise.
constexpr double kMovingMps = 0.5;

// The centres of the occupied voxels, or a given object's corners, as far as an upright box is
// concerned.
struct Footprint {
  Polygon outline_O;
  double min_z_m = std::numeric_limits<double>::infinity(), max_z_m = -min_z_m;
};

// The points of it that an outline can have, in O.
template <class Add>
void ForEachPoint(const PlacedPart& part, Add&& add) {
  const MovingObject& object = *part.object;
  if (object.given()) {
    for (const Eigen::Vector3d& vertex : object.solid->hull->vertices) add(part.T_O_P * vertex);
  }
  const VoxelGrid& grid = object.map_O.grid();
  object.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach(
        [&](int index) { add(part.T_O_P * grid.CenterOf(VoxelAt(block_key, index))); });
  });
}

Footprint FootprintOf(std::span<const PlacedPart> parts) {
  Footprint footprint;
  std::vector<Eigen::Vector2d> points_O;
  for (const PlacedPart& part : parts) {
    ForEachPoint(part, [&](const Eigen::Vector3d& p_O) {
      points_O.push_back(p_O.head<2>());
      footprint.min_z_m = std::min(footprint.min_z_m, p_O.z());
      footprint.max_z_m = std::max(footprint.max_z_m, p_O.z());
    });
  }
  footprint.outline_O = ConvexOutline(points_O);
  // Too thin for an outline: any of them bounds it.
  if (footprint.outline_O.size() < 3) footprint.outline_O = std::move(points_O);
  return footprint;
}

// The box around the footprint with its length along `yaw_rad`.
ObjectExtent ExtentAt(const Footprint& footprint, double yaw_rad) {
  const Eigen::Quaterniond R_O_E(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  Aabb box_E;
  for (const Eigen::Vector2d& p_O : footprint.outline_O) {
    for (const double z_m : {footprint.min_z_m, footprint.max_z_m}) {
      box_E.Extend(R_O_E.conjugate() * Eigen::Vector3d(p_O.x(), p_O.y(), z_m));
    }
  }
  return {yaw_rad, box_E.Size(), R_O_E * box_E.Center()};
}

double AreaOf(const ObjectExtent& extent) { return extent.size_m.x() * extent.size_m.y(); }

// The smallest rectangle lies along an edge of the outline.
ObjectExtent SmallestExtent(const Footprint& footprint) {
  const Polygon& outline_O = footprint.outline_O;
  ObjectExtent best = ExtentAt(footprint, 0);
  for (std::size_t i = 0; i < outline_O.size(); ++i) {
    const Eigen::Vector2d edge = outline_O[(i + 1) % outline_O.size()] - outline_O[i];
    const ObjectExtent extent = ExtentAt(footprint, std::atan2(edge.y(), edge.x()));
    if (AreaOf(extent) < AreaOf(best)) best = extent;
  }
  return best;
}

}  // namespace

ObjectExtent ExtentOf(const MovingObject& object) { return ExtentOf(object, {}); }

ObjectExtent ExtentOf(const MovingObject& object, std::span<const PlacedPart> parts) {
  std::vector<PlacedPart> all = {{&object, Pose()}};
  all.insert(all.end(), parts.begin(), parts.end());
  const Footprint footprint = FootprintOf(all);
  if (footprint.outline_O.empty()) return {};
  ObjectExtent best = SmallestExtent(footprint);
  constexpr double kPi = std::numbers::pi;
  if (best.size_m.x() < best.size_m.y()) best = ExtentAt(footprint, best.yaw_rad + kPi / 2);
  if (!object.given()) best.size_m = best.size_m.cwiseMax(object.map_O.grid().resolution_m());
  if (object.velocity_O && object.velocity_O->linear.norm() >= kMovingMps) {
    const Eigen::Vector2d length(std::cos(best.yaw_rad), std::sin(best.yaw_rad));
    const bool backwards = length.dot(object.velocity_O->linear.head<2>()) < 0;
    if (backwards) best.yaw_rad += best.yaw_rad > 0 ? -kPi : kPi;
  }
  return best;
}

}  // namespace clearway
