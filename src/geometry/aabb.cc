#include "clearway/geometry/aabb.h"

#include <algorithm>

namespace clearway {

Aabb Transformed(const Pose& T_A_B, const Aabb& box_B) {
  if (box_B.Empty()) return {};
  const Eigen::Vector3d center_A = T_A_B * box_B.Center();
  const Eigen::Vector3d half_A =
      T_A_B.rotation.toRotationMatrix().cwiseAbs() * (0.5 * box_B.Size());
  return {center_A - half_A, center_A + half_A};
}

LinePart Clip(const Aabb& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
              LinePart part) {
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < box.min[axis] || origin[axis] > box.max[axis]) return {1, 0};
      continue;
    }
    const double a = (box.min[axis] - origin[axis]) / direction[axis];
    const double b = (box.max[axis] - origin[axis]) / direction[axis];
    part = {std::max(part.begin, std::min(a, b)), std::min(part.end, std::max(a, b))};
  }
  return part;
}

}  // namespace clearway
