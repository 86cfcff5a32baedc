// Axis-aligned boxes.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "clearway/geometry/pose.h"

namespace clearway {

// A closed axis-aligned box in the frame its name states, in metres. Default-constructed it is
// empty. A value.
struct Aabb {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  bool Empty() const { return (min.array() > max.array()).any(); }
  Eigen::Vector3d Center() const { return 0.5 * (min + max); }
  Eigen::Vector3d Size() const { return Empty() ? Eigen::Vector3d::Zero().eval() : max - min; }

  bool Contains(const Eigen::Vector3d& p) const {
    return (p.array() >= min.array()).all() && (p.array() <= max.array()).all();
  }
  // Touching counts.
  bool Intersects(const Aabb& other) const {
    return (min.array() <= other.max.array()).all() && (max.array() >= other.min.array()).all();
  }
  void Extend(const Eigen::Vector3d& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  void Extend(const Aabb& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }
  Aabb Padded(double margin_m) const { return {min.array() - margin_m, max.array() + margin_m}; }
  bool operator==(const Aabb&) const = default;
};

// Of boxes in one frame; empty if they do not touch.
inline Aabb Intersection(const Aabb& a, const Aabb& b) {
  return {a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)};
}

// The smallest box in A that holds `box_B`. An empty box stays empty.
Aabb Transformed(const Pose& T_A_B, const Aabb& box_B);

// The part of [begin, end] in which origin + s * direction lies in the box; empty if begin > end.
struct LinePart {
  double begin, end;
};
LinePart Clip(const Aabb& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
              LinePart part);

}  // namespace clearway
