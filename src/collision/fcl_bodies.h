// Shapes as FCL takes them.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>

#include "clearway/geometry/shape.h"

namespace clearway {

using FclGeometry = fcl::CollisionGeometryd;

// Threads may share it. Of a mesh FCL knows the surface alone.
std::shared_ptr<const FclGeometry> ToFcl(const Shape& shape);

Eigen::Isometry3d Placement(const Eigen::Matrix3d& R, const Eigen::Vector3d& t);

// Two bodies. Their poses are relative to the obstacle's centre, so that nothing is lost far from
// the origin.
struct FclPair {
  const FclGeometry* shape;
  Eigen::Isometry3d shape_pose;
  const FclGeometry* obstacle;
  Eigen::Isometry3d obstacle_pose;
};

// These let out what FCL and libccd throw.
bool Collide(const FclPair& pair);
// In metres, 0 in contact.
double Distance(const FclPair& pair);

}  // namespace clearway
