// Distances that have a closed form. All are in metres and, but for those from surfaces, 0 where
// the sets meet. Any thread may ask.
#pragma once

#include <Eigen/Core>

#include "clearway/geometry/aabb.h"
#include "clearway/geometry/shape.h"

namespace clearway {

double BoxBoxDistance(const Aabb& a, const Aabb& b);
double PointBoxDistance(const Eigen::Vector3d& p, const Aabb& box);

// Of the segment from a to b.
double SegmentBoxDistance(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Aabb& box);

// Ericson, "Real-Time Collision Detection", 2005, sections 5.1.2 and 5.1.5. Corners may coincide or
// lie on a line.
double PointSegmentDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                            const Eigen::Vector3d& b);
double PointTriangleDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                             const Eigen::Vector3d& b, const Eigen::Vector3d& c);

// The point of the solid cylinder nearest to p, p itself inside.
Eigen::Vector3d NearestPoint(const Eigen::Vector3d& p_G, const Cylinder& cylinder);

// How deep a point lies in a sphere, box, capsule or cylinder: a ball round it of this radius is
// inside too. Negative outside; of other shapes always.
double DepthIn(const Shape& shape, const Eigen::Vector3d& p_G);

// From a point to a shape, both in G; shapes are solid in the sense of Contains.
double PointShapeDistance(const Eigen::Vector3d& p_G, const Shape& shape);

// From a point, inside or outside, to the shape's surface. Meshes are asked triangle by triangle.
double SurfaceDistance(const Eigen::Vector3d& p_G, const Shape& shape);

}  // namespace clearway
