// By how much the points of a turning shape stray, by direction.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>

namespace clearway {

// The Minkowski sum of up to two flat discs about the origin: holds every vector by which a point
// may be away from where a sweep puts it. A point that turns about an axis moves across that axis
// alone, so that a turn about a surface's normal takes no point nearer to the surface. A value.
class Spread {
 public:
  struct Disc {
    Eigen::Vector3d axis;  // the disc's normal, of length 1
    double radius_m;
  };

  void Add(const Eigen::Vector3d& axis, double radius_m) {
    if (radius_m != 0) discs_[count_++] = {axis, radius_m};
  }
  bool empty() const { return count_ == 0; }
  std::span<const Disc> discs() const { return {discs_.data(), count_}; }

  // How far it reaches in a direction of length 1. Cross products keep what is small exact.
  double Along(const Eigen::Vector3d& direction) const {
    double reach_m = 0;
    for (const Disc& disc : discs()) reach_m += disc.radius_m * direction.cross(disc.axis).norm();
    return reach_m;
  }
  // The point of it that is farthest in a direction.
  Eigen::Vector3d Farthest(const Eigen::Vector3d& direction) const {
    Eigen::Vector3d farthest = Eigen::Vector3d::Zero();
    for (const Disc& disc : discs()) {
      farthest += disc.radius_m * disc.axis.cross(direction.cross(disc.axis)).normalized();
    }
    return farthest;
  }
  // Of a ball that holds it.
  double radius_m() const {
    double radius_m = 0;
    for (const Disc& disc : discs()) radius_m += disc.radius_m;
    return radius_m;
  }

 private:
  std::array<Disc, 2> discs_;
  std::size_t count_ = 0;
};

}  // namespace clearway
