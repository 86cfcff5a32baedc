#include "report/polygon.h"

namespace clearway::report {

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
