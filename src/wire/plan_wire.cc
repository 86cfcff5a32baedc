#include "wire/plan_wire.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "wire/motion_wire.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

constexpr std::pair<PlanStatus, v1::PlanStatus> kStatuses[] = {
    {PlanStatus::kFound, v1::PLAN_STATUS_FOUND},
    {PlanStatus::kNotFound, v1::PLAN_STATUS_NOT_FOUND},
    {PlanStatus::kStartBlocked, v1::PLAN_STATUS_START_BLOCKED},
    {PlanStatus::kGoalBlocked, v1::PLAN_STATUS_GOAL_BLOCKED},
    {PlanStatus::kNoTimeToSpare, v1::PLAN_STATUS_NO_TIME_TO_SPARE},
};

void WriteSpace(const ConfigurationSpace& space, v1::PlanRequest* proto) {
  if (const auto* plane = std::get_if<PlaneSpace>(&space)) {
    proto->mutable_plane()->set_turns(plane->turns);
    proto->mutable_plane()->set_yaw_rad(plane->yaw_rad);
    proto->mutable_plane()->set_ground_z_m(plane->ground_z_m);
    if (plane->clearance_m) proto->mutable_plane()->set_clearance_m(*plane->clearance_m);
  } else if (const auto* flight = std::get_if<FlightSpace>(&space)) {
    proto->mutable_flight()->set_turns(flight->turns);
  } else {
    const auto& arm = std::get<ArmSpace>(space);
    Write(arm.T_W_B, proto->mutable_arm()->mutable_world_from_base());
    for (const Joint& joint : arm.joints) {
      v1::Joint* const added = proto->mutable_arm()->add_joints();
      Write(joint.T_P_J, added->mutable_parent_from_joint());
      Write(joint.axis_J, added->mutable_axis());
      added->set_min_rad(joint.min_rad);
      added->set_max_rad(joint.max_rad);
      added->set_max_radps(joint.max_radps);
    }
  }
}

ArmSpace ReadArm(const v1::ArmSpace& proto, FieldReader& read) {
  ArmSpace arm;
  arm.T_W_B =
      read.ReadPose("arm.world_from_base", proto.has_world_from_base(), proto.world_from_base());
  for (const v1::Joint& joint : proto.joints()) {
    const std::string field = absl::StrCat("arm.joints[", arm.joints.size(), "].");
    arm.joints.push_back({read.ReadPose(field + "parent_from_joint", joint.has_parent_from_joint(),
                                        joint.parent_from_joint()),
                          read.Vector(field + "axis", joint.has_axis(), joint.axis()),
                          joint.min_rad(), joint.max_rad(), joint.max_radps()});
  }
  return arm;
}

ConfigurationSpace ReadSpace(const v1::PlanRequest& proto, FieldReader& read) {
  if (proto.has_flight()) return FlightSpace{proto.flight().turns()};
  if (proto.has_arm()) return ReadArm(proto.arm(), read);
  read.Require(proto.has_plane(), "space", "is missing: plane, flight or arm");
  PlaneSpace plane;
  plane.turns = proto.plane().turns();
  plane.yaw_rad = proto.plane().yaw_rad();
  plane.ground_z_m = proto.plane().ground_z_m();
  if (proto.plane().has_clearance_m()) plane.clearance_m = proto.plane().clearance_m();
  return plane;
}

// The options are those of CheckMotions, which the plan's certificate goes to.
v1::CheckMotionsRequest OptionsOf(const v1::PlanRequest& proto) {
  v1::CheckMotionsRequest options;
  *options.mutable_options() = proto.options();
  if (proto.has_contact_resolution_m()) {
    options.set_contact_resolution_m(proto.contact_resolution_m());
  }
  return options;
}

}  // namespace

void Write(const PlanTask& task, v1::PlanRequest* proto) {
  v1::CheckMotionsRequest options;
  Write(task.options, &options);
  *proto->mutable_options() = options.options();
  proto->set_contact_resolution_m(options.contact_resolution_m());
  WriteSpace(task.space, proto);
  if (!std::holds_alternative<ArmSpace>(task.space)) {
    Write(task.area_W, proto->mutable_area_world());
  }
  proto->set_max_speed_mps(task.max_speed_mps);
  proto->set_max_turn_radps(task.max_turn_radps);
  proto->mutable_start()->Add(task.start.begin(), task.start.end());
  proto->mutable_goal()->Add(task.goal.begin(), task.goal.end());
  proto->set_start_ns(ToNanoseconds(task.start_time));
  proto->set_time_limit_s(ToSeconds(task.time_limit));
}

absl::StatusOr<PlanTask> ReadPlanTask(const v1::PlanRequest& proto, const ServerLimits& limits) {
  const absl::StatusOr<MotionOptions> options = ReadMotionOptions(OptionsOf(proto), limits);
  if (!options.ok()) return options.status();
  FieldReader read;
  PlanTask task;
  task.options = *options;
  task.space = ReadSpace(proto, read);
  if (!proto.has_arm()) {
    task.area_W = read.Box("area_world", proto.has_area_world(), proto.area_world());
  }
  task.max_speed_mps = proto.max_speed_mps();
  task.max_turn_radps = proto.max_turn_radps();
  task.start.assign(proto.start().begin(), proto.start().end());
  task.goal.assign(proto.goal().begin(), proto.goal().end());
  task.start_time = read.Stamp("start_ns", true, proto.start_ns());
  const double limit_s = read.Positive("time_limit_s", proto.time_limit_s());
  if (limit_s > kMaxTimeLimit_s) {  // no Duration may hold it
    read.Fail("time_limit_s", absl::StrCat("is ", NumberText(limit_s), "; it must be at most ",
                                           NumberText(kMaxTimeLimit_s)));
  }
  if (!read.ok()) return read.status();
  task.time_limit = FromSeconds(limit_s);
  return task;
}

absl::StatusOr<Duration> ReadBudget(const v1::PlanRequest& proto, const ServerLimits& limits) {
  FieldReader read;
  const double budget_s = read.Positive("budget_s", proto.budget_s());
  if (!read.ok()) return read.status();
  if (budget_s <= limits.max_planning_s) return FromSeconds(budget_s);
  return absl::ResourceExhaustedError(absl::StrCat(
      "budget_s: is ", NumberText(budget_s), "; the limit is ", NumberText(limits.max_planning_s)));
}

void Write(const Plan& plan, const v1::PlanRequest& request, std::size_t links,
           v1::PlannedPath* proto) {
  for (const Time time : plan.times) proto->add_times_ns(ToNanoseconds(time));
  for (const auto& values : plan.configurations) {
    proto->mutable_configurations()->Add(values.begin(), values.end());
  }
  v1::CheckMotionsRequest* const certificate = proto->mutable_certificate();
  *certificate = OptionsOf(request);
  certificate->set_robot_id(request.robot_id());
  WriteMotions(plan.motion, links, 0, plan.motion.knot_counts.size(), 0, certificate);
}

absl::StatusOr<Plan> ReadPlan(const v1::PlannedPath& proto, const PlanTask& task,
                              std::size_t links) {
  const std::size_t size = DimensionOf(task.space), states = proto.times_ns_size();
  if (states == 0 || static_cast<std::size_t>(proto.configurations_size()) != states * size) {
    return absl::InternalError("the server's plan does not have a configuration for each time");
  }
  Plan plan;
  for (std::size_t i = 0; i < states; ++i) {
    const auto first = proto.configurations().begin() + static_cast<std::ptrdiff_t>(i * size);
    plan.times.push_back(TimeFromNanoseconds(proto.times_ns(static_cast<int>(i))));
    plan.configurations.emplace_back(first, first + static_cast<std::ptrdiff_t>(size));
  }
  ServerLimits none;
  none.max_states_per_batch = std::numeric_limits<std::uint64_t>::max();
  auto motion = ReadMotions(proto.certificate(), links, none);
  if (!motion.ok()) {
    return absl::InternalError(
        absl::StrCat("the server's plan has a bad motion: ", motion.status().message()));
  }
  plan.motion = *std::move(motion);
  return plan;
}

void Write(const PlanOutcome& outcome, v1::PlanResponse* proto) {
  Write(Versioned{outcome.version, outcome.stamp}, proto->mutable_scene());
  proto->set_horizon_ns(outcome.horizon.count());
  proto->set_inflation_mps(outcome.inflation_mps);
  proto->set_bound_multiple(outcome.bound_multiple);
  for (const auto& [status, on_the_wire] : kStatuses) {
    if (status == outcome.status) proto->set_status(on_the_wire);
  }
  if (outcome.blocker.status == SpaceStatus::kUnresolved) return;
  proto->set_blocked_by(ToProto(outcome.blocker.status));
  proto->set_blocking_link(outcome.blocker.link);
  proto->set_blocking_object_id(outcome.blocker.object);
}

PlanOutcome ReadOutcome(const v1::PlanResponse& proto) {
  const Versioned scene = ReadVersion(proto.scene());
  PlanOutcome outcome;
  outcome.version = scene.version;
  outcome.stamp = scene.stamp;
  outcome.horizon = Duration(proto.horizon_ns());
  outcome.inflation_mps = proto.inflation_mps();
  outcome.bound_multiple = proto.bound_multiple();
  for (const auto& [status, on_the_wire] : kStatuses) {
    if (on_the_wire == proto.status()) outcome.status = status;
  }
  outcome.blocker.status = ReadSpaceStatus(proto.blocked_by());
  outcome.blocker.link = proto.blocking_link();
  outcome.blocker.object = proto.blocking_object_id();
  return outcome;
}

}  // namespace clearway
