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

MovingPart::Passage MovingPart::During(const TimeSpan& span) const {
  const double seconds = span.seconds();
  return {span,
          LinkAt(span.from) * center_L_,
          LinkAt(span.until) * center_L_,
          LinkAt(span.Middle()).rotation,
          center_mps2_ * seconds * seconds / 8,
          turning_mps() * span.half_seconds()};
}

LooseSweep MovingPart::InWorld(const Passage& passage, double margin_m) const {
  return SweepOf(passage.from_W, passage.until_W, passage.R_W_L, margin_m,
                 passage.strays_m + passage.turns_m);
}

MovingBall MovingPart::BallAround(const Passage& passage, double margin_m) const {
  return {passage.span.from, passage.span.until, passage.from_W, passage.until_W,
          0.5 * geometry_->box_G().Size().norm() + passage.strays_m + deviation_m_ + margin_m};
}

// As seen from O, which turns by w, a point at p moves with the acceleration of both, Coriolis' of
// twice w times its speed, and the centrifugal one of w squared times its distance.
LooseSweep MovingPart::InObject(const Passage& passage, const ObjectPiece& object,
                                double margin_m) const {
  const TimeSpan& span = passage.span;
  const Eigen::Vector3d from_O = Inverse(object.At(span.from)) * passage.from_W;
  const Eigen::Vector3d until_O = Inverse(object.At(span.until)) * passage.until_W;
  const double seconds = span.seconds();
  const Twist& velocity_O = object.velocity_O;
  const double spin_radps = velocity_O.angular.norm();
  const double apart_mps = center_mps_ + velocity_O.linear.norm();
  const double apart_m = std::max(from_O.norm(), until_O.norm()) + apart_mps * seconds / 2;
  const double acceleration = center_mps2_ + velocity_O.angular.cross(velocity_O.linear).norm() +
                              2 * spin_radps * apart_mps + spin_radps * spin_radps * apart_m;
  const double strays_m = acceleration * seconds * seconds / 8;
  const double turns_m = passage.turns_m + radius_m_ * spin_radps * span.half_seconds();
  const Eigen::Quaterniond R_O_W = object.At(span.Middle()).rotation.conjugate();
  return SweepOf(from_O, until_O, R_O_W * passage.R_W_L, margin_m, strays_m + turns_m);
}

}  // namespace clearway
