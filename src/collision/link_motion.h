// How a link goes from one knot of a motion to the next.
#pragma once

#include <Eigen/Geometry>

#include "clearway/geometry/pose.h"

namespace clearway {

// Its origin goes straight and its rotation turns the shorter way about one axis, both at constant
// speed. A value.
class LinkMotion {
 public:
  LinkMotion(const Pose& from, const Pose& to, double seconds)
      : from_{from.rotation.normalized(), from.translation},
        way_W_(to.translation - from.translation),
        turn_(from_.rotation.conjugate() * to.rotation.normalized()),
        speed_mps_(way_W_.norm() / seconds),
        spin_radps_(std::abs(turn_.angle()) / seconds) {}

  // `fraction`: of the time, 0 to 1.
  Pose At(double fraction) const {
    return {from_.rotation * Eigen::AngleAxisd(fraction * turn_.angle(), turn_.axis()),
            from_.translation + fraction * way_W_};
  }
  double speed_mps() const { return speed_mps_; }    // of the origin
  double spin_radps() const { return spin_radps_; }  // about the origin
  Eigen::Vector3d AxisInL() const { return turn_.axis(); }
  Eigen::Vector3d AxisInW() const { return from_.rotation * turn_.axis(); }

 private:
  Pose from_;
  Eigen::Vector3d way_W_;
  Eigen::AngleAxisd turn_;  // in L
  double speed_mps_, spin_radps_;
};

}  // namespace clearway
