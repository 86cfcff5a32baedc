#include "collision/moving_part.h"

#include <algorithm>
#include <variant>

namespace clearway {
namespace {

double TurningRadius(const ShapeGeometry& geometry) {
  if (std::holds_alternative<Sphere>(geometry.shape())) return 0;
  if (const auto* capsule = std::get_if<Capsule>(&geometry.shape())) {
    return 0.5 * capsule->length_m;
  }
  return 0.5 * geometry.box_G().Size().norm();
}

}  // namespace

MovingPart::MovingPart(int link, const LinkMotion& motion, const TimeSpan& leg,
                       const RobotGeometry::Part& part, double deviation_m)
    : link_(link),
      motion_(&motion),
      leg_(leg),
      geometry_(&part.geometry),
      T_L_G_(part.T_L_G.value_or(Pose{})),
      center_L_(T_L_G_ * part.geometry.box_G().Center()),
      radius_m_(TurningRadius(part.geometry)),
      deviation_m_(deviation_m),
      center_mps_(motion.speed_mps() + motion.spin_radps() * center_L_.norm()),
      center_mps2_(motion.spin_radps() * motion.spin_radps() * center_L_.norm()) {}

LooseSweep MovingPart::SweepOf(const Eigen::Vector3d& from_F, const Eigen::Vector3d& until_F,
                               const Eigen::Quaterniond& R_F_L, double margin_m,
                               double slack_m) const {
  const Eigen::Quaterniond R_F_G = R_F_L * T_L_G_.rotation;
  const Eigen::Vector3d origin_F = from_F - R_F_G * geometry_->box_G().Center();
  return {{PlacedShape(*geometry_, {R_F_G, origin_F}), until_F - from_F,
           margin_m + deviation_m_ + slack_m, 0.25 * slack_m},
          slack_m};
}

LooseSweep MovingPart::InWorld(const TimeSpan& span, double margin_m) const {
  const double seconds = span.seconds();
  const double strays_m = center_mps2_ * seconds * seconds / 8;
  const double turns_m = radius_m_ * motion_->spin_radps() * seconds / 2;
  return SweepOf(LinkAt(span.from) * center_L_, LinkAt(span.until) * center_L_,
                 LinkAt(span.Middle()).rotation, margin_m, strays_m + turns_m);
}

// As seen from O, which turns by w, a point at p moves with the acceleration of both, Coriolis' of
// twice w times its speed, and the centrifugal one of w squared times its distance.
LooseSweep MovingPart::InObject(const ObjectPiece& object, const TimeSpan& span,
                                double margin_m) const {
  const Pose T_O_W_from = Inverse(object.At(span.from)),
             T_O_W_until = Inverse(object.At(span.until));
  const Eigen::Vector3d from_O = T_O_W_from * (LinkAt(span.from) * center_L_);
  const Eigen::Vector3d until_O = T_O_W_until * (LinkAt(span.until) * center_L_);
  const double seconds = span.seconds();
  const Twist& velocity_O = object.velocity_O;
  const double spin_radps = velocity_O.angular.norm();
  const double apart_mps = center_mps_ + velocity_O.linear.norm();
  const double apart_m = std::max(from_O.norm(), until_O.norm()) + apart_mps * seconds / 2;
  const double acceleration = center_mps2_ + velocity_O.angular.cross(velocity_O.linear).norm() +
                              2 * spin_radps * apart_mps + spin_radps * spin_radps * apart_m;
  const double strays_m = acceleration * seconds * seconds / 8;
  const double turns_m = radius_m_ * (motion_->spin_radps() + spin_radps) * seconds / 2;
  const Eigen::Quaterniond R_O_W = object.At(span.Middle()).rotation.conjugate();
  return SweepOf(from_O, until_O, R_O_W * LinkAt(span.Middle()).rotation, margin_m,
                 strays_m + turns_m);
}

}  // namespace clearway
