// Scans of a room of walls, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/frames.h"

namespace clearway::testing_support {

// Of 12 x 8 x 3 m, level, the floor 1 m below W's origin. No wall lies between two voxels.
inline const Aabb kRoom_W{{-5.03, -3.04, -0.96}, {6.97, 4.96, 2.04}};

// Where the ray from p, inside, meets the walls.
inline Eigen::Vector3d OnWall(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W) {
  double reach_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double side = direction_W[axis] > 0 ? kRoom_W.max[axis] : kRoom_W.min[axis];
    if (direction_W[axis] != 0) reach_m = std::min(reach_m, (side - p_W[axis]) / direction_W[axis]);
  }
  return p_W + reach_m * direction_W;
}

// What a sensor sees of it at T_W_S, in S.
inline std::vector<Eigen::Vector3d> SeenOfRoom(const Pose& T_W_S) {
  constexpr int kRows = 40, kColumns = 180;
  const Pose T_S_W = Inverse(T_W_S);
  std::vector<Eigen::Vector3d> points_S;
  for (int row = 0; row < kRows; ++row) {
    const double up = std::numbers::pi * ((row + 0.5) / kRows - 0.5);
    for (int column = 0; column < kColumns; ++column) {
      const double around = 2 * std::numbers::pi * column / kColumns;
      const Eigen::Vector3d direction_S(std::cos(up) * std::cos(around),
                                        std::cos(up) * std::sin(around), std::sin(up));
      points_S.push_back(T_S_W * OnWall(T_W_S.translation, T_W_S.rotation * direction_S));
    }
  }
  return points_S;
}

// The scan as a source tells it that takes the sensor to be at T_V_S.
inline Frame ScanOfRoom(double seconds, const Pose& T_W_S, const Pose& T_V_S) {
  Frame frame = FrameAt(seconds);
  frame.T_W_S = T_V_S;
  for (const Eigen::Vector3d& p_S : SeenOfRoom(T_W_S)) AddPoint(frame, kStaticLabel, p_S);
  return frame;
}

}  // namespace clearway::testing_support
