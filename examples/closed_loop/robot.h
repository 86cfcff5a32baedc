// The robot that drives in the loop.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/base/time.h"
#include "clearway/collision/robot.h"
#include "clearway/geometry/aabb.h"
#include "clearway/planning/state_mapping.h"

namespace clearway::closed_loop {

// An upright body that goes any way at once and does not turn. A plain value.
struct Carrier {
  Shape body = Cylinder{0.3, 1.0};
  double yaw_rad = 0;
  double max_speed_mps = 1.5;
  Ground ground;  // that it stands on

  Robot Model() const { return Robot::SingleShape("carrier", body); }
  // T_W_L of its one link.
  Pose LinkPose(const Eigen::Vector2d& p_W) const;
};

// What a carrier is to do: to go to a goal and to stay there. A plain value.
struct Errand {
  Carrier carrier;
  Eigen::Vector2d start_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_W = Eigen::Vector2d::Zero();
  Aabb area_W;  // where it may go
};

// Where to be when: straight and evenly from knot to knot; before the first and after the last one
// it stands still there. Never empty. A value.
class TimedPath {
 public:
  struct Knot {
    Time time;
    Eigen::Vector2d p_W;
  };

  // At rest.
  TimedPath(Time from, const Eigen::Vector2d& p_W) : knots_{{from, p_W}} {}
  // Of at least one knot, at ascending times.
  explicit TimedPath(std::vector<Knot> knots) : knots_(std::move(knots)) {}

  Eigen::Vector2d At(Time time) const;
  const std::vector<Knot>& knots() const { return knots_; }
  Time end_time() const { return knots_.back().time; }
  const Eigen::Vector2d& end_W() const { return knots_.back().p_W; }

 private:
  std::vector<Knot> knots_;
};

}  // namespace clearway::closed_loop
