// The robot that drives in the loop.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/base/time.h"
#include "clearway/collision/robot.h"

namespace clearway::closed_loop {

// An upright cylinder that goes any way at once, with its LiDAR on its axis.
inline constexpr double kRobotRadius_m = 0.3, kRobotHeight_m = 1.0;
inline constexpr double kGroundClearance_m = 0.1, kSensorHeight_m = 0.8;
inline constexpr double kRobotSpeed_mps = 1.5;

Robot MakeRobot();

// T_W_L of the robot's one link, and T_W_S of its sensor, which does not turn.
Pose LinkPose(const Eigen::Vector2d& p_W);
Pose SensorPose(const Eigen::Vector2d& p_W);

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
