// Rays against shapes, exactly.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "clearway/geometry/aabb.h"
#include "clearway/geometry/shape.h"

namespace clearway {

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

// The part of a line that lies in a convex set: distances from the origin along the direction;
// empty if enter > leave.
struct RayInterval {
  double enter = -kNoHit;
  double leave = kNoHit;
};

RayInterval IntervalInBox(const Aabb& box_G, const Eigen::Vector3d& origin_G,
                          const Eigen::Vector3d& direction_G);

// Distance from origin to where the ray first crosses the shape's surface, or kNoHit. Seen from
// inside, that is where it leaves. `direction_G` has unit length. Not for TriangleMesh, which needs
// a MeshBvh: kNoHit.
double RayDistance(const Shape& shape, const Eigen::Vector3d& origin_G,
                   const Eigen::Vector3d& direction_G);

// Against one triangle, seen from either side; Moeller and Trumbore, "Fast, Minimum Storage
// Ray/Triangle Intersection", 1997.
double RayDistanceToTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c, const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction);

}  // namespace clearway
