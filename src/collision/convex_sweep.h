// Convex bodies on a straight way.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "collision/advance.h"
#include "collision/separation.h"

namespace clearway {

struct ConvexBody {
  FarthestPoint farthest;
  Eigen::Vector3d center;  // or any other point near it
};

// Before which share of its way a body is farther than margin_m from one that stands still, from
// the share `from` on; kNever if that is so up to `until`.
inline double FirstTouchOf(const ConvexBody& moving, const Eigen::Vector3d& way,
                           const ConvexBody& standing, double margin_m, double from, double until) {
  Eigen::Vector3d look = standing.center - moving.center - from * way;
  return AdvanceAlong(way, margin_m, from, until, [&](double share) {
    const Separation apart = FindSeparation(
        [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
          return moving.farthest(direction) + share * way;
        },
        standing.farthest, look, margin_m,
        [&](const Separation& found) {
          const double used_m = (until - share) * found.direction.dot(way);
          return found.gap_m - margin_m - kKept_m > std::max(0.0, used_m);
        });
    look = apart.direction;
    return apart;
  });
}

}  // namespace clearway
