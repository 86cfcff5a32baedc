// The sweeps that hold a moving shape for a while.
#pragma once

#include "clearway/base/time.h"
#include "clearway/scene/object_index.h"
#include "collision/link_motion.h"
#include "collision/object_motion_piece.h"
#include "collision/robot_geometry.h"
#include "collision/sweep.h"
#include "collision/turn_bound.h"

namespace clearway {

struct TimeSpan {
  Time from, until;

  double seconds() const { return ToSeconds(until - from); }
  Time Middle() const { return from + (until - from) / 2; }            // rounded down
  double half_seconds() const { return ToSeconds(until - Middle()); }  // the longer half
  Time At(double share) const {                                        // rounded down
    return from +
           Duration(static_cast<std::int64_t>(share * static_cast<double>((until - from).count())));
  }
};

// A sweep, and by how much it is larger than what is asked for: what the shape strays from the
// sweep's straight way and turns away from its one orientation.
struct LooseSweep {
  Sweep sweep;
  double slack_m;
};

// One shape of a link on one leg of a motion. Its centre is carried along the chord of its way, as
// it is turned in the middle of the span; what a point strays from that goes to the sweep's spread:
// with an acceleration of at most `a`, the way strays from its chord by no more than a t^2 / 8, and
// across the axis alone about which it turns. Against an object, this is done as seen from the
// object. (Schwarzer, Saha and Latombe, "Adaptive Dynamic Collision Checking for Single and
// Multiple Articulated Robots in Complex Environments", 2005, bound motions likewise; Zhang, Redon,
// Lee and Kim, "Continuous Collision Detection for Articulated Models using Taylor Models and
// Temporal Culling", 2007, section 5, by direction.) Refers to what it is made of.
class MovingPart {
 public:
  // The link moves from `leg`.from to `leg`.until.
  MovingPart(int link, const LinkMotion& motion, const TimeSpan& leg,
             const RobotGeometry::Part& part, double deviation_m);

  int link() const { return link_; }
  double center_mps() const { return center_mps_; }  // at most
  // Of the shape, seen from the centre: at most.
  double turning_mps() const { return turn_.larger_m() * motion_->spin_radps(); }

  // What a span of the leg is, whatever it is seen from.
  struct Passage {
    TimeSpan span;
    Eigen::Vector3d from_W, until_W;  // the centre
    Eigen::Quaterniond R_W_L;         // in the middle
    double turned_rad;                // from the middle, at most
    double strays_m;                  // the centre from its chord, across the axis
  };
  Passage During(const TimeSpan& span) const;

  // In W; margin_m is what is asked for.
  LooseSweep InWorld(const Passage& passage, double margin_m) const;
  // In the frame O of an object that moves alike all the while.
  LooseSweep InObject(const Passage& passage, const ObjectPiece& object, double margin_m) const;
  // Holds all of it.
  MovingBall BallAround(const Passage& passage, double margin_m) const;

 private:
  Pose LinkAt(Time t) const { return motion_->At(ToSeconds(t - leg_.from) / leg_.seconds()); }
  // `strays_m`: in any direction, beyond the spread.
  LooseSweep SweepOf(const Eigen::Vector3d& from_F, const Eigen::Vector3d& until_F,
                     const Eigen::Quaterniond& R_F_L, double margin_m, double strays_m,
                     const Spread& spread_F) const;

  int link_;
  const LinkMotion* motion_;
  TimeSpan leg_;
  const ShapeGeometry* geometry_;
  Pose T_L_G_;
  Eigen::Vector3d center_L_;
  Eigen::Vector3d axis_W_;  // of the link's turn
  double radius_m_;         // of a ball about the centre that holds the shape
  TurnBound turn_;          // the link's
  double deviation_m_;
  double center_mps_;   // at most
  double center_mps2_;  // its acceleration, across the axis
};

}  // namespace clearway
