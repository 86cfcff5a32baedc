#include "report/polygon.h"

#include <algorithm>

namespace clearway::report {
namespace {

double Cross(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

}  // namespace

Polygon ConvexOutline(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  Polygon hull;
  const auto chain = [&hull](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= base + 2 && Cross(hull[hull.size() - 2], hull.back(), *p) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    if (!hull.empty()) hull.pop_back();  // the other chain starts with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

Polygon OutlineOf(const Solid& solid, const Pose& T_W_O) {
  std::vector<Eigen::Vector2d> points_W;
  points_W.reserve(solid.hull->vertices.size());
  for (const Eigen::Vector3d& p_O : solid.hull->vertices) {
    points_W.push_back((T_W_O * p_O).head<2>());
  }
  return ConvexOutline(std::move(points_W));
}

Polygon Moved(const Polygon& polygon_F, const Pose& T_W_F) {
  Polygon polygon_W;
  for (const Eigen::Vector2d& p_F : polygon_F) {
    polygon_W.push_back((T_W_F * Eigen::Vector3d(p_F.x(), p_F.y(), 0)).head<2>());
  }
  return polygon_W;
}

}  // namespace clearway::report
