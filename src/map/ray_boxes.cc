#include "map/ray_boxes.h"

#include <limits>

#include "base/multiversion.h"

namespace clearway {
namespace {

// Eight boxes, a lane each.
struct LaneBoxes {
  LaneFloats min[3], max[3];
};

void Extend(const LaneFloats (&point)[3], LaneBoxes& boxes) {
  for (int axis = 0; axis < 3; ++axis) {
    boxes.min[axis] = point[axis] < boxes.min[axis] ? point[axis] : boxes.min[axis];
    boxes.max[axis] = point[axis] > boxes.max[axis] ? point[axis] : boxes.max[axis];
  }
}

CLEARWAY_MULTIVERSION void Extend(std::span<const RaySegments> rays, LaneBoxes& origins,
                                  LaneBoxes& ends) {
  for (const RaySegments& eight : rays) {
    Extend(eight.origin, origins);
    Extend(eight.end, ends);
  }
}

LaneBoxes Empty() {
  constexpr float kFar = std::numeric_limits<float>::max();
  LaneBoxes boxes;
  for (int axis = 0; axis < 3; ++axis) {
    boxes.min[axis] = LaneFloats{} + kFar;
    boxes.max[axis] = LaneFloats{} - kFar;
  }
  return boxes;
}

Eigen::AlignedBox3f Around(const LaneBoxes& boxes) {
  Eigen::AlignedBox3f box;
  for (int lane = 0; lane < kLanes; ++lane) {
    box.extend(Eigen::Vector3f(boxes.min[0][lane], boxes.min[1][lane], boxes.min[2][lane]));
    box.extend(Eigen::Vector3f(boxes.max[0][lane], boxes.max[1][lane], boxes.max[2][lane]));
  }
  return box;
}

}  // namespace

RayBoxes BoxesAround(std::span<const RaySegments> rays) {
  if (rays.empty()) return {};
  LaneBoxes origins = Empty(), ends = Empty();
  Extend(rays, origins, ends);
  return {Around(origins), Around(ends)};
}

}  // namespace clearway
