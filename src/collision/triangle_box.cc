#include "collision/triangle_box.h"

#include <algorithm>
#include <cmath>

#include "clearway/geometry/distance.h"

namespace clearway {
namespace {

constexpr double kTouching_m = 1e-9;

Triangle SeenFrom(const OrientedBox& box, const Triangle& t) {
  return {box.ToB(t.a), box.ToB(t.b), box.ToB(t.c)};
}

// Whether the box of half edges `half_m` about the origin and the triangle are apart along one of
// the cross products of B's axes with the edge from `from`; `third` is the corner off that edge.
bool ApartAcross(const Eigen::Vector3d& edge, const Eigen::Vector3d& from,
                 const Eigen::Vector3d& third, const Eigen::Vector3d& half_m) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double at_edge = edge[u] * from[v] - edge[v] * from[u];
    const double at_third = edge[u] * third[v] - edge[v] * third[u];
    const double reach = half_m[u] * std::abs(edge[v]) + half_m[v] * std::abs(edge[u]);
    if (std::min(at_edge, at_third) > reach || std::max(at_edge, at_third) < -reach) return true;
  }
  return false;
}

// Whether they are apart along the triangle's normal. All corners are looked at, for the normal of
// a triangle without an area is any vector.
bool ApartAlongNormal(const Triangle& t, const Eigen::Vector3d& half_m) {
  const Eigen::Vector3d normal = (t.b - t.a).cross(t.c - t.a);
  const double at_a = normal.dot(t.a), at_b = normal.dot(t.b), at_c = normal.dot(t.c);
  const double reach = normal.cwiseAbs().dot(half_m);
  return std::min({at_a, at_b, at_c}) > reach || std::max({at_a, at_b, at_c}) < -reach;
}

bool MeetAtOrigin(const Triangle& t, const Eigen::Vector3d& half_m) {
  const Eigen::Vector3d low = t.a.cwiseMin(t.b).cwiseMin(t.c);
  const Eigen::Vector3d high = t.a.cwiseMax(t.b).cwiseMax(t.c);
  if ((low.array() > half_m.array()).any() || (high.array() < -half_m.array()).any()) return false;
  return !ApartAlongNormal(t, half_m) && !ApartAcross(t.b - t.a, t.a, t.c, half_m) &&
         !ApartAcross(t.c - t.b, t.b, t.a, half_m) && !ApartAcross(t.a - t.c, t.c, t.b, half_m);
}

}  // namespace

bool Meet(const Triangle& triangle_G, const OrientedBox& box) {
  return MeetAtOrigin(SeenFrom(box, triangle_G), box.half_m.array() + kTouching_m);
}

// Of two convex bodies that are apart, a nearest pair has the triangle's edge, or else its inside
// and the box's corner that is the lowest above the triangle's plane.
double Distance(const Triangle& triangle_G, const OrientedBox& box, double up_to_m) {
  const Triangle t = SeenFrom(box, triangle_G);
  const Aabb around_t{t.a.cwiseMin(t.b).cwiseMin(t.c), t.a.cwiseMax(t.b).cwiseMax(t.c)};
  const Aabb around{-box.half_m, box.half_m};
  const double at_least_m = BoxBoxDistance(around_t, around);
  if (at_least_m > up_to_m) return at_least_m;
  if (MeetAtOrigin(t, box.half_m.array() + kTouching_m)) return 0;
  const double to_edges_m =
      std::min({SegmentBoxDistance(t.a, t.b, around), SegmentBoxDistance(t.b, t.c, around),
                SegmentBoxDistance(t.c, t.a, around)});
  Eigen::Vector3d normal = (t.b - t.a).cross(t.c - t.a);
  if (normal.dot(t.a) > 0) normal = -normal;  // now from the plane to the box's centre
  Eigen::Vector3d corner;
  for (int axis = 0; axis < 3; ++axis)
    corner[axis] = -std::copysign(box.half_m[axis], normal[axis]);
  return std::min(to_edges_m, PointTriangleDistance(corner, t.a, t.b, t.c));
}

}  // namespace clearway
