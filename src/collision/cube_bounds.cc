#include "collision/cube_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/multiversion.h"

namespace clearway {
namespace {

// A TurnedBox with a radius, as plain numbers.
struct Core {
  double r[3][3];  // R_F_G by rows
  double origin[3], half[3];
  double radius_m;
};

Core CoreOf(const TurnedBox& box, double radius_m) {
  Core core{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) core.r[i][k] = box.R_F_G(i, k);
    core.origin[i] = box.origin_F[i];
    core.half[i] = box.half_m[i];
  }
  core.radius_m = radius_m;
  return core;
}

constexpr double kRounding_m = 1e-9;
constexpr double kTiny = std::numeric_limits<double>::min();  // instead of 0, to divide by

// CubeContact::FromCore for every cube.
CLEARWAY_MULTIVERSION void BoundAll(const Core& core, double half_edge_m, BoundedCubes& cubes) {
  const Core c = core;  // that nothing written to `cubes` may change
  for (std::size_t i = 0; i < cubes.count; ++i) {
    const double dx = cubes.x_m[i] - c.origin[0], dy = cubes.y_m[i] - c.origin[1],
                 dz = cubes.z_m[i] - c.origin[2];
    const double gx = c.r[0][0] * dx + c.r[1][0] * dy + c.r[2][0] * dz;
    const double gy = c.r[0][1] * dx + c.r[1][1] * dy + c.r[2][1] * dz;
    const double gz = c.r[0][2] * dx + c.r[1][2] * dy + c.r[2][2] * dz;
    const double ex = gx - std::max(std::min(gx, c.half[0]), -c.half[0]);
    const double ey = gy - std::max(std::min(gy, c.half[1]), -c.half[1]);
    const double ez = gz - std::max(std::min(gz, c.half[2]), -c.half[2]);
    const double fx = std::abs(c.r[0][0] * ex + c.r[0][1] * ey + c.r[0][2] * ez);
    const double fy = std::abs(c.r[1][0] * ex + c.r[1][1] * ey + c.r[1][2] * ez);
    const double fz = std::abs(c.r[2][0] * ex + c.r[2][1] * ey + c.r[2][2] * ez);
    const double distance_m = std::sqrt(std::max(fx * fx + fy * fy + fz * fz, kTiny));
    const double to_plane_m = distance_m - half_edge_m * (fx + fy + fz) / distance_m;
    const double ax = std::max(fx - half_edge_m, 0.0), ay = std::max(fy - half_edge_m, 0.0),
                 az = std::max(fz - half_edge_m, 0.0);
    const double to_point_m = std::sqrt(ax * ax + ay * ay + az * az);
    cubes.least_m[i] = std::max(to_plane_m - c.radius_m, 0.0) - kRounding_m;
    cubes.most_m[i] = std::max(to_point_m - c.radius_m, 0.0) + kRounding_m;
  }
}

TurnedBox AsBox(const RoundedLine& line) {
  const Eigen::Matrix3d R_F_G =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), line.axis_F).toRotationMatrix();
  return {R_F_G, line.center_F, {0, 0, line.half_m}};
}

}  // namespace

CubeBounds::CubeBounds(const PlacedShape& shape) : one_by_one_(shape, 0), box_(shape.AsBox()) {
  if (const auto line = shape.AsRoundedLine()) {
    box_ = AsBox(*line);
    radius_m_ = line->radius_m;
  }
}

void CubeBounds::Bound(double half_edge_m, BoundedCubes& cubes) const {
  if (box_) {
    BoundAll(CoreOf(*box_, radius_m_), half_edge_m, cubes);
    return;
  }
  for (std::size_t i = 0; i < cubes.count; ++i) {
    const Eigen::Vector3d center_F(cubes.x_m[i], cubes.y_m[i], cubes.z_m[i]);
    const auto [least_m, most_m] = one_by_one_.DistanceTo(center_F, half_edge_m);
    cubes.least_m[i] = least_m;
    cubes.most_m[i] = most_m;
  }
}

}  // namespace clearway
