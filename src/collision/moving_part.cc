#include "collision/moving_part.h"

#include <algorithm>

namespace clearway {

MovingPart::MovingPart(int link, const LinkMotion& motion, const TimeSpan& leg,
                       const RobotGeometry::Part& part, double deviation_m)
    : link_(link),
      motion_(&motion),
      leg_(leg),
      geometry_(&part.geometry),
      T_L_G_(part.T_L_G.value_or(Pose{})),
      center_L_(T_L_G_ * part.geometry.box_G().Center()),
      axis_W_(motion.AxisInW()),
      radius_m_(0.5 * part.geometry.box_G().Size().norm()),
      turn_(BoundOfTurn(part.geometry, T_L_G_.rotation.conjugate() * motion.AxisInL())),
      deviation_m_(deviation_m) {
  const double from_axis_m = center_L_.cross(motion.AxisInL()).norm();
  center_mps_ = motion.speed_mps() + motion.spin_radps() * from_axis_m;
  center_mps2_ = motion.spin_radps() * motion.spin_radps() * from_axis_m;
}

LooseSweep MovingPart::SweepOf(const Eigen::Vector3d& from_F, const Eigen::Vector3d& until_F,
                               const Eigen::Quaterniond& R_F_L, double margin_m, double strays_m,
                               const Spread& spread_F) const {
  const Eigen::Quaterniond R_F_G = R_F_L * T_L_G_.rotation;
  const Eigen::Vector3d origin_F = from_F - R_F_G * geometry_->box_G().Center();
  const double slack_m = strays_m + spread_F.radius_m();
  return {{PlacedShape(*geometry_, {R_F_G, origin_F}), until_F - from_F,
           margin_m + deviation_m_ + strays_m, 0.25 * slack_m, spread_F},
          slack_m};
}

MovingPart::Passage MovingPart::During(const TimeSpan& span) const {
  const double seconds = span.seconds();
  return {span,
          LinkAt(span.from) * center_L_,
          LinkAt(span.until) * center_L_,
          LinkAt(span.Middle()).rotation,
          motion_->spin_radps() * span.half_seconds(),
          center_mps2_ * seconds * seconds / 8};
}

LooseSweep MovingPart::InWorld(const Passage& passage, double margin_m) const {
  Spread spread_W;
  spread_W.Add(axis_W_, passage.strays_m + turn_.across_m * passage.turned_rad);
  return SweepOf(passage.from_W, passage.until_W, passage.R_W_L, margin_m,
                 turn_.any_m * passage.turned_rad, spread_W);
}

MovingBall MovingPart::BallAround(const Passage& passage, double margin_m) const {
  return {passage.span.from, passage.span.until, passage.from_W, passage.until_W,
          radius_m_ + passage.strays_m + deviation_m_ + margin_m};
}

// Let the object turn by w. As seen from O the link turns by R_O_W R_W_L: about its own axis u, and
// then, by what the object turns, about w. By then the link's turn has moved the shape relative to
// w by an angle of at most turned_rad |u x w|, and the object's has moved u by the like.
//
// A point at p moves with the acceleration of its own, which is across u, Coriolis' of twice w
// times its speed in W, w times the object's speed, and the centrifugal one of w squared times its
// distance, which are across w.
LooseSweep MovingPart::InObject(const Passage& passage, const ObjectPiece& object,
                                double margin_m) const {
  const TimeSpan& span = passage.span;
  const Eigen::Vector3d from_O = Inverse(object.At(span.from)) * passage.from_W;
  const Eigen::Vector3d until_O = Inverse(object.At(span.until)) * passage.until_W;
  const Eigen::Quaterniond R_O_W = object.At(span.Middle()).rotation.conjugate();
  const Eigen::Quaterniond R_O_L = R_O_W * passage.R_W_L;
  const Twist& velocity_O = object.velocity_O;
  const double spin_radps = velocity_O.angular.norm();
  Spread spread_O;
  const Eigen::Vector3d own_axis_O = R_O_W * axis_W_;
  spread_O.Add(own_axis_O, passage.strays_m + turn_.across_m * passage.turned_rad);
  double strays_m = turn_.any_m * passage.turned_rad;
  if (spin_radps > 0) {
    const Eigen::Vector3d axis_O = velocity_O.angular / spin_radps;
    const double aslant = own_axis_O.cross(axis_O).norm();
    const double turned_rad = spin_radps * span.half_seconds();
    const TurnBound turn = BoundOfTurn(*geometry_, (R_O_L * T_L_G_.rotation).conjugate() * axis_O,
                                       passage.turned_rad * aslant);
    const double seconds = span.seconds(), apart_mps = center_mps_ + velocity_O.linear.norm();
    const double apart_m = std::max(from_O.norm(), until_O.norm()) + apart_mps * seconds / 2;
    const double acceleration = velocity_O.angular.cross(velocity_O.linear).norm() +
                                2 * spin_radps * center_mps_ + spin_radps * spin_radps * apart_m;
    spread_O.Add(axis_O, acceleration * seconds * seconds / 8 + turn.across_m * turned_rad);
    strays_m += turn.any_m * turned_rad + passage.strays_m * turned_rad * aslant;
  }
  return SweepOf(from_O, until_O, R_O_L, margin_m, strays_m, spread_O);
}

}  // namespace clearway
