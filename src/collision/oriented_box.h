// Boxes that are turned against the frame they are seen from.
#pragma once

#include <Eigen/Core>

namespace clearway {

// A closed box whose edges lie along the axes of a frame B, seen from a frame G. A value.
struct OrientedBox {
  OrientedBox(const Eigen::Vector3d& center_in_G, const Eigen::Matrix3d& R_B_from_G,
              const Eigen::Vector3d& half_edges_m)
      : center_G(center_in_G),
        R_B_G(R_B_from_G),
        half_m(half_edges_m),
        abs_R_B_G(R_B_from_G.cwiseAbs()),
        reach_G(abs_R_B_G.transpose() * half_edges_m) {}

  OrientedBox Padded(double by_m) const { return {center_G, R_B_G, half_m.array() + by_m}; }

  Eigen::Vector3d center_G;
  Eigen::Matrix3d R_B_G;
  Eigen::Vector3d half_m;  // of its edges, along B's axes
  Eigen::Matrix3d abs_R_B_G;
  Eigen::Vector3d reach_G;  // half the smallest box in G around it

  // From the box's centre, in B.
  Eigen::Vector3d ToB(const Eigen::Vector3d& p_G) const { return R_B_G * (p_G - center_G); }
};

}  // namespace clearway
