// A robot that has to cross the way of a moving object.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/collision/robot.h"
#include "clearway/geometry/timed_pose.h"
#include "clearway/planning/state_mapping.h"
#include "clearway/report/truth.h"

namespace clearway::demo {

// One planning problem. The robot is a box, x forward, that stands upright on the ground.
struct Crossing {
  std::string name;
  ObjectId blocker = 0;  // whose way is crossed
  Eigen::Vector3d robot_size_m{1.0, 0.7, 1.0};
  double max_speed_mps = 2.0;
  Time now;                                        // the newest frame known
  Duration time_limit = std::chrono::seconds(12);  // from now to the arrival
  Eigen::Vector2d start_W = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_W = Eigen::Vector2d::Zero();
  double shift_m = 0;  // along the object's path, from the place that was asked for

  double Yaw() const;  // of the way from start to goal
  // The robot to plan with: wider by `margin_m` on all sides, but not taller, for below it there is
  // the ground.
  Box RobotBody(double margin_m) const {
    return {robot_size_m + 2 * margin_m * Eigen::Vector3d(1, 1, 0)};
  }
  Robot RobotModel(double margin_m) const {
    return Robot::SingleShape("delivery robot", RobotBody(margin_m));
  }
};

// The way across the recorded path of `blocker`, from 4 m on its left to 4 m on its right (or, if
// `from_right`, the other way), where it will be 1.5 s after `now`, `shift_m` further along its
// path. NOT_FOUND if the object is not recorded there.
absl::StatusOr<Crossing> MakeCrossing(const Truth& truth, ObjectId blocker, Time now,
                                      double shift_m, bool from_right);

// A plane z = c + a x + b y in W, x and y counted from `center_W`.
struct GroundPlane {
  Eigen::Vector2d center_W = Eigen::Vector2d::Zero();
  Eigen::Vector3d coefficients = Eigen::Vector3d::Zero();  // c, a, b
  double HeightM(double x_m, double y_m) const {
    return coefficients.dot(Eigen::Vector3d(1, x_m - center_W.x(), y_m - center_W.y()));
  }
  double Slope() const { return coefficients.tail<2>().norm(); }
  // For planners of a robot that is kept `clearance_m` above it.
  Ground Under(double clearance_m) const;
};

// The plane through the lowest occupied voxels within `radius_m` of the way. FAILED_PRECONDITION if
// there are too few to tell.
absl::StatusOr<GroundPlane> FitGround(const VoxelMap& static_map_W, const Crossing& crossing,
                                      double radius_m);

// The robot's first contact with what really was there, and how close it came to the objects.
struct Verdict {
  std::optional<Time> contact;
  ObjectId touched = 0;  // by the contact; 0: the static world
  double closest_m = 0;  // to an object; at most 3 m
  Time checked_until;    // the path's end, or the end of what is known
};

// Drives the path past the truth, in steps of 10 ms.
Verdict Judge(const Truth& truth, const Crossing& crossing, const std::vector<TimedPose>& path);

// The straight way at full speed.
std::vector<TimedPose> StraightWay(const Crossing& crossing, const GroundPlane& ground,
                                   double clearance_m);

}  // namespace clearway::demo
