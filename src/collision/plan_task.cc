#include "clearway/collision/plan_task.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/geometry/unit_quaternion.h"
#include "clearway/scene/frame.h"
#include "collision/validation.h"

namespace clearway {
namespace {

constexpr double kMost_m = 100'000, kMostReach_m = 100, kMostSpeed = 1'000, kMostAngle_rad = 1'000;
constexpr std::size_t kMostJoints = 32;

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

absl::Status CheckWithin(const std::string& field, double value, double least, double most) {
  if (value >= least && value <= most) return absl::OkStatus();  // so that NaN fails
  return Invalid(field, absl::StrCat("is ", NumberText(value), "; it must lie between ",
                                     NumberText(least), " and ", NumberText(most)));
}

absl::Status CheckLimit(const std::string& field, double value) {
  if (value > 0 && value <= kMostSpeed) return absl::OkStatus();
  return Invalid(field, absl::StrCat("is ", NumberText(value), "; it must be above 0, and at most ",
                                     NumberText(kMostSpeed)));
}

absl::Status CheckJoint(const std::string& field, const Joint& joint) {
  if (auto status = ValidatePose(field + ".parent_from_joint", joint.T_P_J, kMostReach_m);
      !status.ok()) {
    return status;
  }
  if (!joint.axis_J.allFinite() || !(joint.axis_J.norm() > 1e-6)) {
    return Invalid(field + ".axis", "has no direction");
  }
  if (auto status = CheckWithin(field + ".min_rad", joint.min_rad, -kMostAngle_rad, kMostAngle_rad);
      !status.ok()) {
    return status;
  }
  if (auto status = CheckWithin(field + ".max_rad", joint.max_rad, -kMostAngle_rad, kMostAngle_rad);
      !status.ok()) {
    return status;
  }
  if (joint.min_rad > joint.max_rad) {
    return absl::InvalidArgumentError(
        absl::StrCat(field, ": min_rad is ", NumberText(joint.min_rad),
                     "; it must be at most max_rad, which is ", NumberText(joint.max_rad)));
  }
  const bool locked = joint.min_rad == joint.max_rad;
  if (locked && joint.max_radps == 0) return absl::OkStatus();
  return CheckLimit(field + ".max_radps", joint.max_radps);
}

absl::Status CheckSpace(const ConfigurationSpace& space, const Robot& robot) {
  if (const auto* plane = std::get_if<PlaneSpace>(&space)) {
    for (const auto& [field, value, least] :
         {std::tuple{"plane.yaw_rad", plane->yaw_rad, -kMost_m},
          {"plane.ground_z_m", plane->ground_z_m, -kMost_m},
          {"plane.clearance_m", plane->clearance_m.value_or(0), 0.0}}) {
      if (auto status = CheckWithin(field, value, least, kMost_m); !status.ok()) return status;
    }
  }
  const auto* arm = std::get_if<ArmSpace>(&space);
  if (arm == nullptr) return absl::OkStatus();
  if (arm->joints.empty() || arm->joints.size() > kMostJoints) {
    return Invalid("arm.joints",
                   absl::StrCat("are ", arm->joints.size(), "; at least 1 and at most ",
                                kMostJoints, " are needed"));
  }
  if (arm->joints.size() + 1 != robot.links.size()) {
    return Invalid("arm.joints", absl::StrCat("are ", arm->joints.size(), "; the robot has ",
                                              robot.links.size(), " links, one more is needed"));
  }
  for (std::size_t i = 0; i < arm->joints.size(); ++i) {
    const std::string field = absl::StrCat("arm.joints[", i, "]");
    if (auto status = CheckJoint(field, arm->joints[i]); !status.ok()) return status;
  }
  return ValidatePose("arm.world_from_base", arm->T_W_B, kMost_m);
}

// Of the axes that configurations have: x and y, and of those that fly z.
absl::Status CheckArea(const PlanTask& task) {
  if (std::holds_alternative<ArmSpace>(task.space)) return absl::OkStatus();
  const int axes = std::holds_alternative<PlaneSpace>(task.space) ? 2 : 3;
  for (int axis = 0; axis < axes; ++axis) {
    const double low = task.area_W.min[axis], high = task.area_W.max[axis];
    if (low >= -kMost_m && low <= high && high <= kMost_m) continue;
    return Invalid(
        absl::StrCat("area.", std::string(1, static_cast<char>('x' + axis))),
        absl::StrCat("is from ", NumberText(low), " to ", NumberText(high),
                     "; the first must be at most the second, both within ", NumberText(kMost_m)));
  }
  if (auto status = CheckLimit("max_speed_mps", task.max_speed_mps); !status.ok()) return status;
  return Turns(task.space) ? CheckLimit("max_turn_radps", task.max_turn_radps) : absl::OkStatus();
}

absl::Status CheckArmConfiguration(const std::string& field, const std::vector<double>& values,
                                   const ArmSpace& arm) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (auto status = CheckWithin(absl::StrCat(field, "[", i, "]"), values[i],
                                  arm.joints[i].min_rad, arm.joints[i].max_rad);
        !status.ok()) {
      return status;
    }
  }
  return absl::OkStatus();
}

absl::Status CheckConfiguration(const std::string& field, const std::vector<double>& values,
                                const PlanTask& task) {
  const std::size_t size = DimensionOf(task.space);
  if (values.size() != size) {
    return Invalid(field, absl::StrCat("has ", values.size(), " numbers; it must have ", size));
  }
  if (const auto* arm = std::get_if<ArmSpace>(&task.space)) {
    return CheckArmConfiguration(field, values, *arm);
  }
  const std::size_t axes = std::holds_alternative<PlaneSpace>(task.space) ? 2 : 3;
  for (std::size_t i = 0; i < size; ++i) {
    const bool place = i < axes;
    if (auto status = CheckWithin(absl::StrCat(field, "[", i, "]"), values[i],
                                  place ? task.area_W.min[i] : -kMostAngle_rad,
                                  place ? task.area_W.max[i] : kMostAngle_rad);
        !status.ok()) {
      return status;
    }
  }
  if (size != 7) return absl::OkStatus();
  const Eigen::Quaterniond rotation(values[6], values[3], values[4], values[5]);
  if (IsNearlyUnit(rotation)) return absl::OkStatus();
  return Invalid(field, absl::StrCat("has a quaternion that ", NotUnitText(rotation)));
}

}  // namespace

double DefaultGroundClearance(double resolution_m, double padding_m) {
  return 1.5 * resolution_m + padding_m;
}

bool Turns(const ConfigurationSpace& space) {
  const auto* plane = std::get_if<PlaneSpace>(&space);
  const auto* flight = std::get_if<FlightSpace>(&space);
  return (plane != nullptr && plane->turns) || (flight != nullptr && flight->turns);
}

std::size_t DimensionOf(const ConfigurationSpace& space) {
  if (const auto* plane = std::get_if<PlaneSpace>(&space)) return plane->turns ? 3 : 2;
  if (const auto* flight = std::get_if<FlightSpace>(&space)) return flight->turns ? 7 : 3;
  return std::get<ArmSpace>(space).joints.size();
}

std::vector<double> NormalizedConfiguration(const ConfigurationSpace& space,
                                            std::vector<double> values) {
  const auto* flight = std::get_if<FlightSpace>(&space);
  if (flight == nullptr || !flight->turns) return values;
  const Eigen::Quaterniond q =
      Normalized(Eigen::Quaterniond(values[6], values[3], values[4], values[5]));
  for (int i = 0; i < 4; ++i) values[3 + i] = q.coeffs()[i];
  return values;
}

absl::Status Validate(const PlanTask& task, const Robot& robot) {
  // First, since a clearance that is not given comes from the padding.
  if (auto status = Validate(task.options, robot); !status.ok()) return status;
  if (auto status = CheckSpace(task.space, robot); !status.ok()) return status;
  if (auto status = CheckArea(task); !status.ok()) return status;
  if (auto status = CheckConfiguration("start", task.start, task); !status.ok()) return status;
  if (auto status = CheckConfiguration("goal", task.goal, task); !status.ok()) return status;
  if (task.time_limit <= Duration::zero() || ToSeconds(task.time_limit) > kMaxTimeLimit_s) {
    return Invalid("time_limit_s",
                   absl::StrCat("is ", NumberText(ToSeconds(task.time_limit)),
                                "; it must be above 0, and at most ", NumberText(kMaxTimeLimit_s)));
  }
  if (auto status = ValidateTime("start_ns", task.start_time); !status.ok()) return status;
  const Time latest_start = TimeFromNanoseconds(kFarthest_ns) - task.time_limit;
  if (task.start_time > latest_start) {
    return Invalid("start_ns", absl::StrCat("is ", ToNanoseconds(task.start_time),
                                            "; with this time limit it must be at most ",
                                            ToNanoseconds(latest_start)));
  }
  if (task.options.world_at) return Invalid("world_at_ns", "is not for plans");
  return absl::OkStatus();
}

}  // namespace clearway
