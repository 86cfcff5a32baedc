#include "clearway/geometry/aabb.h"

namespace clearway {

Aabb Transformed(const Pose& T_A_B, const Aabb& box_B) {
  if (box_B.Empty()) return {};
  const Eigen::Vector3d center_A = T_A_B * box_B.Center();
  const Eigen::Vector3d half_A =
      T_A_B.rotation.toRotationMatrix().cwiseAbs() * (0.5 * box_B.Size());
  return {center_A - half_A, center_A + half_A};
}

}  // namespace clearway
