#include "planning/task_space.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <algorithm>

#include "clearway/collision/scene_checker.h"
#include "clearway/planning/arm.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
using RState = ob::RealVectorStateSpace::StateType;
using Se2State = ob::SE2StateSpace::StateType;
using Se3State = ob::SE3StateSpace::StateType;

ob::RealVectorBounds BoundsOf(const Aabb& area_W, unsigned int axes) {
  ob::RealVectorBounds bounds(axes);
  for (unsigned int axis = 0; axis < axes; ++axis) {
    bounds.setLow(axis, area_W.min[axis]);
    bounds.setHigh(axis, area_W.max[axis]);
  }
  return bounds;
}

// R^n that may be a single point: OMPL refuses spaces without an extent.
class Coordinates : public ob::RealVectorStateSpace {
 public:
  using ob::RealVectorStateSpace::RealVectorStateSpace;
  double getMaximumExtent() const override {
    constexpr double kLeast = 1e-9;
    return std::max(kLeast, ob::RealVectorStateSpace::getMaximumExtent());
  }
};

// SE(2) or SE(3) whose positions may be a single point.
template <class Base, unsigned int kAxes>
class RigidPoses : public Base {
 public:
  RigidPoses() { this->components_[0] = std::make_shared<Coordinates>(kAxes); }
};

template <class Space>
ob::StateSpacePtr Bounded(std::shared_ptr<Space> space, const ob::RealVectorBounds& bounds) {
  space->setBounds(bounds);
  return space;
}

ob::StateSpacePtr PartOf(const PlanTask& task) {
  if (const auto* plane = std::get_if<PlaneSpace>(&task.space)) {
    const ob::RealVectorBounds bounds = BoundsOf(task.area_W, 2);
    return plane->turns ? Bounded(std::make_shared<RigidPoses<ob::SE2StateSpace, 2>>(), bounds)
                        : Bounded(std::make_shared<Coordinates>(2), bounds);
  }
  if (const auto* flight = std::get_if<FlightSpace>(&task.space)) {
    const ob::RealVectorBounds bounds = BoundsOf(task.area_W, 3);
    return flight->turns ? Bounded(std::make_shared<RigidPoses<ob::SE3StateSpace, 3>>(), bounds)
                         : Bounded(std::make_shared<Coordinates>(3), bounds);
  }
  const std::vector<Joint>& joints = std::get<ArmSpace>(task.space).joints;
  ob::RealVectorBounds bounds(static_cast<unsigned int>(joints.size()));
  for (unsigned int i = 0; i < joints.size(); ++i) {
    bounds.setLow(i, joints[i].min_rad);
    bounds.setHigh(i, joints[i].max_rad);
  }
  return Bounded(std::make_shared<Coordinates>(static_cast<unsigned int>(joints.size())), bounds);
}

SpeedLimits LimitsOf(const PlanTask& task) {
  SpeedLimits limits;
  if (const auto* arm = std::get_if<ArmSpace>(&task.space)) {
    for (const Joint& joint : arm->joints) {
      const bool locked = joint.min_rad == joint.max_rad;
      limits.axes_per_s.push_back(locked ? 1 : joint.max_radps);  // OMPL's limit is above 0
    }
    return limits;
  }
  limits.translation_mps = task.max_speed_mps;
  if (task.max_turn_radps > 0) limits.rotation_radps = task.max_turn_radps;
  return limits;
}

bool IsSe2(const ConfigurationSpace& space) {
  const auto* plane = std::get_if<PlaneSpace>(&space);
  return plane != nullptr && plane->turns;
}

bool IsSe3(const ConfigurationSpace& space) {
  const auto* flight = std::get_if<FlightSpace>(&space);
  return flight != nullptr && flight->turns;
}

}  // namespace

std::shared_ptr<SpaceTimeStateSpace> SpaceOf(const PlanTask& task) {
  return std::make_shared<SpaceTimeStateSpace>(PartOf(task), LimitsOf(task), task.time_limit);
}

StateMapping MappingOf(const PlanTask& task, const Robot& robot) {
  const TimeSince time{task.start_time};
  if (const auto* arm = std::get_if<ArmSpace>(&task.space)) return ArmMapping(robot, *arm, time);
  if (const auto* plane = std::get_if<PlaneSpace>(&task.space)) {
    Ground ground;
    ground.clearance_m = plane->ground_z_m + plane->clearance_m.value_or(0);
    return plane->turns ? StateMapping::Se2(robot, ground, time)
                        : StateMapping::R2(robot, ground, time, plane->yaw_rad);
  }
  return std::get<FlightSpace>(task.space).turns ? StateMapping::Se3(robot, time)
                                                 : StateMapping::R3(robot, time);
}

PlanTask WithClearance(PlanTask task, const StateChecker& checker) {
  auto* const plane = std::get_if<PlaneSpace>(&task.space);
  if (plane == nullptr || plane->clearance_m) return task;
  const auto* const local = dynamic_cast<const SceneChecker*>(&checker);
  const SceneParams params = local != nullptr ? local->scene().params : SceneParams{};
  plane->clearance_m = DefaultGroundClearance(params.resolution_m, task.options.check.padding_m);
  return task;
}

void WriteConfiguration(const ConfigurationSpace& space, const std::vector<double>& values,
                        ob::State* part) {
  if (IsSe2(space)) {
    part->as<Se2State>()->setXY(values[0], values[1]);
    part->as<Se2State>()->setYaw(values[2]);
  } else if (IsSe3(space)) {
    auto& state = *part->as<Se3State>();
    state.setXYZ(values[0], values[1], values[2]);
    auto& rotation = state.rotation();
    rotation.x = values[3];
    rotation.y = values[4];
    rotation.z = values[5];
    rotation.w = values[6];
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) (*part->as<RState>())[i] = values[i];
  }
}

std::vector<double> ReadConfiguration(const ConfigurationSpace& space, const ob::State* part) {
  if (IsSe2(space)) {
    const auto& state = *part->as<Se2State>();
    return {state.getX(), state.getY(), state.getYaw()};
  }
  if (IsSe3(space)) {
    const auto& state = *part->as<Se3State>();
    const auto& rotation = state.rotation();
    return {state.getX(), state.getY(), state.getZ(), rotation.x,
            rotation.y,   rotation.z,   rotation.w};
  }
  const double* const values = part->as<RState>()->values;
  return {values, values + DimensionOf(space)};
}

}  // namespace clearway
