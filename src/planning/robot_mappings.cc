// The mappings of rigid robots and of kinematics that the caller gives.
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "clearway/planning/state_mapping.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
using Se2State = ob::SE2StateSpace::StateType;
using Se3State = ob::SE3StateSpace::StateType;
using RState = ob::RealVectorStateSpace::StateType;

Aabb BoxOf(const Robot& robot) {
  Aabb box_L;
  for (const Link& link : robot.links) {
    for (const LinkShape& shape : link.shapes) {
      box_L.Extend(Transformed(shape.T_L_G, BoundingBox(shape.shape)));
    }
  }
  return box_L;
}

// The distance of the box's farthest corner from L's origin, or from its z axis.
Eigen::Vector3d FarthestCorner(const Robot& robot) {
  const Aabb box_L = BoxOf(robot);
  return box_L.min.cwiseAbs().cwiseMax(box_L.max.cwiseAbs());
}

std::optional<double> SlopeOf(const Ground& ground) {
  return ground.height_m ? ground.max_slope : 0;
}

std::function<double(double, double)> LinkHeight(const Robot& robot, Ground ground) {
  const double above_ground_m = ground.clearance_m - BoxOf(robot).min.z();
  if (!ground.height_m) return [above_ground_m](double, double) { return above_ground_m; };
  return [height_m = std::move(ground.height_m), above_ground_m](double x_m, double y_m) {
    return height_m(x_m, y_m) + above_ground_m;
  };
}

void SetAll(std::span<Pose> T_W_L, const Pose& pose) { std::ranges::fill(T_W_L, pose); }

double Distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm(); }

Eigen::Quaterniond AboutZ(double yaw_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
}

double AngleBetween(double yaw_a, double yaw_b) {
  return std::abs(std::remainder(yaw_a - yaw_b, 2 * std::numbers::pi));
}

Eigen::Quaterniond RotationOf(const Se3State& state) {
  const auto& q = state.rotation();
  return {q.w, q.x, q.y, q.z};
}

const RState& AsR(const ob::State* state) { return *state->as<RState>(); }

}  // namespace

StateMapping StateMapping::Se2(const Robot& robot, Ground ground, TimeSource time) {
  const auto z_m = LinkHeight(robot, ground);
  const double radius_m = FarthestCorner(robot).head<2>().norm();
  auto kinematics = [z_m](const ob::State* state, std::span<Pose> T_W_L) {
    const auto& s = *state->as<Se2State>();
    SetAll(T_W_L, {AboutZ(s.getYaw()), {s.getX(), s.getY(), z_m(s.getX(), s.getY())}});
  };
  auto bound = [z_m, radius_m](const ob::State* from, const ob::State* to) {
    const auto& a = *from->as<Se2State>();
    const auto& b = *to->as<Se2State>();
    return Distance({a.getX(), a.getY(), z_m(a.getX(), a.getY())},
                    {b.getX(), b.getY(), z_m(b.getX(), b.getY())}) +
           radius_m * AngleBetween(a.getYaw(), b.getYaw());
  };
  StateMapping mapping(Kind::kSe2, robot.links.size(), kinematics, bound, time);
  mapping.slope_ = SlopeOf(ground);
  return mapping;
}

StateMapping StateMapping::R2(const Robot& robot, Ground ground, TimeSource time, double yaw_rad) {
  auto position = [z_m = LinkHeight(robot, ground)](const ob::State* state) {
    const RState& s = AsR(state);
    return Eigen::Vector3d(s[0], s[1], z_m(s[0], s[1]));
  };
  auto kinematics = [position, yaw_rad](const ob::State* state, std::span<Pose> T_W_L) {
    SetAll(T_W_L, {AboutZ(yaw_rad), position(state)});
  };
  auto bound = [position](const ob::State* from, const ob::State* to) {
    return Distance(position(from), position(to));
  };
  StateMapping mapping(Kind::kR2, robot.links.size(), kinematics, bound, time);
  mapping.slope_ = SlopeOf(ground);
  return mapping;
}

StateMapping StateMapping::Se3(const Robot& robot, TimeSource time) {
  auto kinematics = [](const ob::State* state, std::span<Pose> T_W_L) {
    const auto& s = *state->as<Se3State>();
    SetAll(T_W_L, {RotationOf(s), {s.getX(), s.getY(), s.getZ()}});
  };
  auto bound = [radius_m = FarthestCorner(robot).norm()](const ob::State* from,
                                                         const ob::State* to) {
    const auto& a = *from->as<Se3State>();
    const auto& b = *to->as<Se3State>();
    return Distance({a.getX(), a.getY(), a.getZ()}, {b.getX(), b.getY(), b.getZ()}) +
           radius_m * RotationOf(a).angularDistance(RotationOf(b));
  };
  return StateMapping(Kind::kSe3, robot.links.size(), kinematics, bound, time);
}

StateMapping StateMapping::R3(const Robot& robot, TimeSource time) {
  auto position = [](const ob::State* state) {
    const RState& s = AsR(state);
    return Eigen::Vector3d(s[0], s[1], s[2]);
  };
  auto kinematics = [position](const ob::State* state, std::span<Pose> T_W_L) {
    SetAll(T_W_L, {Eigen::Quaterniond::Identity(), position(state)});
  };
  auto bound = [position](const ob::State* from, const ob::State* to) {
    return Distance(position(from), position(to));
  };
  return StateMapping(Kind::kR3, robot.links.size(), kinematics, bound, time);
}

StateMapping StateMapping::FromKinematics(const Robot& robot, Kinematics kinematics,
                                          TimeSource time, MotionBound bound,
                                          DeviationBound deviations) {
  StateMapping mapping(Kind::kOther, robot.links.size(), std::move(kinematics), std::move(bound),
                       time);
  for (const Link& link : robot.links) {
    mapping.reaches_m_.push_back(FarthestCorner({robot.name, {link}}).norm());
  }
  mapping.deviations_ = std::move(deviations);
  return mapping;
}

}  // namespace clearway
