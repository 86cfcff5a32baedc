// Convex bodies on a straight way.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "collision/advance.h"
#include "collision/separation.h"
#include "collision/spread.h"

namespace clearway {

struct ConvexBody {
  FarthestPoint farthest;
  Eigen::Vector3d center;  // or any other point near it
};

// The gap along the axes of the first body's turns, which move none of its points along them: the
// greatest one. Minus infinity if it does not turn.
inline Separation ApartAlongAxes(const Spread& spread, FarthestPoint first, FarthestPoint second) {
  constexpr double kRounding_m = 1e-9;
  Separation best;
  for (const auto& [axis, radius_m] : spread.discs()) {
    for (const Eigen::Vector3d& direction : {axis, Eigen::Vector3d(-axis)}) {
      const double apart_m = direction.dot(second(-direction) - first(direction));
      const double gap_m = apart_m - spread.Along(direction) - kRounding_m;
      if (gap_m > best.gap_m) best = {direction, gap_m};
    }
  }
  return best;
}

// Before which share of its way a body that spreads is farther than margin_m from one that stands
// still, from the share `from` on; kNever if that is so up to `until`. GJK runs without the spread,
// which is round: between polytopes it needs half the iterations.
inline double FirstTouchOf(const ConvexBody& moving, const Eigen::Vector3d& way,
                           const ConvexBody& standing, double margin_m, const Spread& spread,
                           double from, double until) {
  Eigen::Vector3d look = standing.center - moving.center - from * way;
  return AdvanceAlong(way, margin_m, from, until, [&](double share) {
    const auto moved = [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
      return moving.farthest(direction) + share * way;
    };
    Separation apart =
        FindSeparation(moved, standing.farthest, look, margin_m, [&](const Separation& found) {
          const double left_m = found.gap_m - spread.Along(found.direction) - margin_m - kKept_m;
          return left_m > std::max(0.0, (until - share) * found.direction.dot(way));
        });
    look = apart.direction;
    apart.gap_m -= spread.Along(apart.direction);
    const Separation along = ApartAlongAxes(spread, moved, standing.farthest);
    return along.gap_m > apart.gap_m ? along : apart;
  });
}

}  // namespace clearway
