// Whether two views can be of one rigid body.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "clearway/geometry/pose.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// An object's points in a frame, as indices into its cloud. A view into both.
struct ObjectView {
  const LabelledCloud& cloud;
  std::span<const std::uint32_t> points;
};

// How far an object is from where it is said to be, and how far it may be.
struct Mismatch {
  double off_m = 0, limit_m = 0;
};

// Compares a view with one of `seconds` earlier, since which the object is said to have moved by
// H_W, to within `bound_m`. They do not match if
// - both ends of what is seen lie farther than H_W carries those of the earlier view, by more than
//   the limit, and
// - rays tell that this is no other part of a long object: they go on through where the other view
//   saw it, and would have met it if it were rigid and had moved so.
std::optional<Mismatch> MismatchOf(const ObjectView& then, const ObjectView& now, const Pose& H_W,
                                   double seconds, double bound_m, const SceneParams& params);

}  // namespace clearway
