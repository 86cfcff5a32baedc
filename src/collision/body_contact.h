// A robot's shape against one convex body.
#pragma once

#include <optional>

#include "collision/convex_sweep.h"
#include "collision/sweep.h"

namespace clearway {

// Whether the distance is at most margin_m; none if that is so only up to rounding.
std::optional<bool> Meets(const PlacedShape& shape_F, const ConvexBody& body_F, double margin_m);

// Before which share of the sweep's way, from the share `from` on, its shape is farther from the
// body than its margin, its spread and `beyond_m`; kNever if that is so up to `until`. A mesh that
// is not closed counts as its convex hull here: what may be inside it has no surface all round.
double FirstTouchOf(const Sweep& sweep, const ConvexBody& body_F, double beyond_m, double from,
                    double until);

}  // namespace clearway
