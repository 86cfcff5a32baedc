// Bodies of FCL for the brute force reference.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>

#include "clearway/collision/state_checker.h"

namespace clearway {

using FclGeometry = std::shared_ptr<fcl::CollisionGeometryd>;

// A body in three sizes: as it is, and half a micrometre or so smaller and larger.
struct Sizes {
  FclGeometry smaller, exact, larger;
};
Sizes BoxSizes(const Eigen::Vector3d& size);
Sizes BallSizes(double radius_m);
Sizes SolidSizes(const Solid& solid);

struct Obstacle {
  ObjectId id = kStaticLabel;
  SpaceStatus status = SpaceStatus::kOccupied;
  Sizes geometry;
  Eigen::Isometry3d pose_W = Eigen::Isometry3d::Identity();
  double radius_m = 0;  // about pose_W's origin
  double margin_m = 0;
};

// One shape of a robot.
struct RobotBody {
  FclGeometry geometry;
  Eigen::Isometry3d pose_W;
  const Shape* shape;
  double radius_m;
};
FclGeometry GeometryOf(const Shape& shape);
double RadiusOf(const Shape& shape);
Eigen::Isometry3d AsIsometry(const Pose& pose);

double Distance(const RobotBody& body, const FclGeometry& obstacle,
                const Eigen::Isometry3d& pose_W);

enum class Verdict { kApart, kUnsure, kTouching };
Verdict Touches(const RobotBody& body, const Obstacle& obstacle, double margin_m);

}  // namespace clearway
