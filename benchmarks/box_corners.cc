#include "box_corners.h"

#include <algorithm>

namespace clearway::bench {

std::span<const RecordedBox> BoxesOf(const LidarFolder& folder, int frame) {
  return std::ranges::equal_range(folder.boxes, frame, {}, &RecordedBox::frame);
}

void SeeBoxes(const LidarFolder& folder, Frame& frame) {
  frame.points_S.clear();
  frame.labels.clear();
  const Pose T_S_W = Inverse(frame.T_W_S);
  for (const RecordedBox& box : BoxesOf(folder, static_cast<int>(frame.sequence))) {
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d sides(corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5,
                                  corner & 4 ? 0.5 : -0.5);
      const Eigen::Vector3d p_S = T_S_W * box.T_W_B * box.size_m.cwiseProduct(sides);
      frame.points_S.push_back(p_S.cast<float>());
      frame.labels.push_back(box.id);
    }
  }
}

}  // namespace clearway::bench
