// Boxes around rays.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "map/ray_lanes.h"

namespace clearway {

// Where rays begin, and where they end.
struct RayBoxes {
  Eigen::AlignedBox3f origins, ends;

  void Extend(const RayBoxes& others) {
    origins.extend(others.origins);
    ends.extend(others.ends);
  }
};

// Those that go nowhere count, too. Looks at each.
RayBoxes BoxesAround(std::span<const RaySegments> rays);

}  // namespace clearway
