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
    if (radius_m == 0) return;
    discs_[count_++] = {axis, radius_m};
    radius_m_ += radius_m;
    for (int i = 0; i < 3; ++i) {
      half_m_[i] += radius_m * Eigen::Vector3d::Unit(i).cross(axis).norm();
    }
  }
  Spread Turned(const Eigen::Matrix3d& rotation) const {
    Spread turned;
    for (const auto& [axis, radius_m] : discs()) turned.Add(rotation * axis, radius_m);
    return turned;
  }
  bool empty() const { return count_ == 0; }
  std::span<const Disc> discs() const { return {discs_.data(), count_}; }

  // How far it reaches in a direction of length 1. Cross products keep what is small exact.
  double Along(const Eigen::Vector3d& direction) const {
    double reach_m = 0;
    for (const Disc& disc : discs()) reach_m += disc.radius_m * direction.cross(disc.axis).norm();
    return reach_m;
  }
  double radius_m() const { return radius_m_; }              // of a ball that holds it
  const Eigen::Vector3d& half_m() const { return half_m_; }  // of the smallest box round it

 private:
  std::array<Disc, 2> discs_;
  std::size_t count_ = 0;
  double radius_m_ = 0;
  Eigen::Vector3d half_m_ = Eigen::Vector3d::Zero();
};

}  // namespace clearway
