#include "io/polygon_cutter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

using Point = Eigen::Vector2d;
using Corners = std::vector<Eigen::Vector3d>;

constexpr double kSliver = 1e-3;  // a polygon's width over its length

// Above 0 if the way from a over b to c turns left: twice the area of the triangle.
double Turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool Overlap(double a, double b, double c, double d) {
  return std::max(a, b) >= std::min(c, d) && std::max(c, d) >= std::min(a, b);
}

// Whether both are on the same side of a line, by their turns, and not on it.
bool SameSide(double turn, double other) {
  return (turn > 0 && other > 0) || (turn < 0 && other < 0);
}

// Whether the segments from a to b and from c to d have a point in common.
bool Meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  return Overlap(a.x(), b.x(), c.x(), d.x()) && Overlap(a.y(), b.y(), c.y(), d.y()) &&
         !SameSide(Turn(a, b, c), Turn(a, b, d)) && !SameSide(Turn(c, d, a), Turn(c, d, b));
}

}  // namespace

absl::Status PolygonCutter::Cut(const Corners& corners) {
  triangles_.clear();
  if (corners.size() > kMaxCorners) {
    return absl::InvalidArgumentError(
        absl::StrCat("has ", corners.size(), " corners; the limit is ", kMaxCorners));
  }
  DropRepeatedCorners(corners);
  if (ring_.size() < 3) return absl::OkStatus();
  const Eigen::Vector3d normal = Normal(corners);
  if (!std::isfinite(normal.norm())) {
    return absl::InvalidArgumentError("is too large: its area is not finite");
  }
  Project(corners, normal);
  Link();
  const bool is_convex = IsConvex();
  corner_pairs_ += ring_.size() * (is_convex ? blockers_.size() : ring_.size());
  if (corner_pairs_ > kMaxCornerPairs) {
    return absl::ResourceExhaustedError("is one concave polygon too many: export triangles");
  }
  if ((is_convex || IsSimple()) && ClipEars()) return absl::OkStatus();
  triangles_.clear();
  if (!IsSliver(corners)) {
    return absl::InvalidArgumentError("crosses or touches itself: export triangles");
  }
  Fan();
  return absl::OkStatus();
}

void PolygonCutter::DropRepeatedCorners(const Corners& corners) {
  ring_.clear();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!ring_.empty() && corners[ring_.back()] == corners[i]) continue;
    ring_.push_back(static_cast<std::uint32_t>(i));
  }
  while (ring_.size() > 1 && corners[ring_.back()] == corners[ring_.front()]) ring_.pop_back();
}

// Newell's: twice the area, along the side from which the polygon is counter-clockwise.
Eigen::Vector3d PolygonCutter::Normal(const Corners& corners) const {
  const Eigen::Vector3d& first = corners[ring_[0]];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < ring_.size(); ++i) {
    normal += (corners[ring_[i]] - first).cross(corners[ring_[i + 1]] - first);
  }
  return normal;
}

// Drops the coordinate along which the polygon's area is largest: the other two are exact.
void PolygonCutter::Project(const Corners& corners, const Eigen::Vector3d& normal) {
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const Eigen::Index x = (axis + 1) % 3, y = (axis + 2) % 3;
  points_.clear();
  for (const std::uint32_t corner : ring_) {
    const Eigen::Vector3d& p = corners[corner];
    points_.push_back(normal[axis] < 0 ? Point(p[y], p[x]) : Point(p[x], p[y]));
  }
}

bool PolygonCutter::IsSliver(const Corners& corners) const {
  const Eigen::Vector3d& first = corners[ring_[0]];
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  for (const std::uint32_t corner : ring_) {
    const Eigen::Vector3d line = corners[corner] - first;
    if (line.squaredNorm() > longest.squaredNorm()) longest = line;
  }
  return std::ranges::all_of(ring_, [&](std::uint32_t corner) {
    return longest.cross(corners[corner] - first).norm() <= kSliver * longest.squaredNorm();
  });
}

// Whether it turns left at each corner, or not at all, and once around: its direction goes from the
// right half of the plane to the left one and back.
bool PolygonCutter::IsConvex() const {
  const std::size_t count = points_.size();
  const auto goes_right = [&](std::size_t i) {
    const Point step = points_[(i + 1) % count] - points_[i % count];
    return step.x() > 0 || (step.x() == 0 && step.y() > 0);
  };
  int changes = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Point& b = points_[(i + 1) % count];
    if (Turn(points_[i], b, points_[(i + 2) % count]) < 0) return false;
    if (goes_right(i) != goes_right(i + 1)) ++changes;
  }
  return changes == 2;
}

// Whether no two edges have a point in common, but for the corner of neighbours.
bool PolygonCutter::IsSimple() const {
  const std::size_t count = points_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Point &a = points_[i], &b = points_[(i + 1) % count], &c = points_[(i + 2) % count];
    if (Turn(a, b, c) == 0 && (b - a).dot(c - b) <= 0) return false;  // back along the same line
    for (std::size_t k = i + 2; k < count; ++k) {
      if ((k + 1) % count == i) continue;
      if (Meet(a, b, points_[k], points_[(k + 1) % count])) return false;
    }
  }
  return true;
}

void PolygonCutter::Link() {
  const std::size_t count = ring_.size();
  previous_.resize(count);
  next_.resize(count);
  is_ear_.resize(count);
  blockers_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    previous_[i] = (i + count - 1) % count;
    next_[i] = (i + 1) % count;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(TurnAt(i) > 0)) blockers_.push_back(i);
  }
}

// Only the neighbours of an ear that is clipped may become ears or cease to be some.
bool PolygonCutter::ClipEars() {
  for (std::size_t i = 0; i < ring_.size(); ++i) is_ear_[i] = IsEar(i);
  std::size_t at = 1, left = ring_.size(), passed = 0;
  while (left > 3) {
    if (is_ear_[at] != 0) {
      Clip(at);
      --left;
      passed = 0;
    } else if (++passed > left) {
      return false;
    }
    at = next_[at];
  }
  if (!(TurnAt(at) > 0)) return false;
  AddTriangle(previous_[at], at, next_[at]);
  return true;
}

double PolygonCutter::TurnAt(std::size_t i) const {
  return Turn(points_[previous_[i]], points_[i], points_[next_[i]]);
}

// Whether point i is convex and its triangle holds no other point: if it holds any, it holds one
// that is not convex.
bool PolygonCutter::IsEar(std::size_t i) const {
  const std::size_t before = previous_[i], after = next_[i];
  const Point &a = points_[before], &b = points_[i], &c = points_[after];
  if (!(Turn(a, b, c) > 0)) return false;
  return std::ranges::none_of(blockers_, [&](std::size_t k) {
    const Point& p = points_[k];
    return k != before && k != after && Turn(a, b, p) >= 0 && Turn(b, c, p) >= 0 &&
           Turn(c, a, p) >= 0;
  });
}

void PolygonCutter::Clip(std::size_t i) {
  const std::size_t before = previous_[i], after = next_[i];
  AddTriangle(before, i, after);
  next_[before] = after;
  previous_[after] = before;
  for (const std::size_t k : {before, after}) {
    if (TurnAt(k) > 0) std::erase(blockers_, k);
  }
  for (const std::size_t k : {before, after}) is_ear_[k] = IsEar(k);
}

void PolygonCutter::AddTriangle(std::size_t a, std::size_t b, std::size_t c) {
  triangles_.push_back({ring_[a], ring_[b], ring_[c]});
}

void PolygonCutter::Fan() {
  for (std::size_t i = 1; i + 1 < ring_.size(); ++i) AddTriangle(0, i, i + 1);
}

}  // namespace clearway
