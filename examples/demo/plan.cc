#include "demo/plan.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"
#include "clearway/planning/path_check.h"
#include "clearway/planning/space_time_setup.h"

namespace clearway::demo {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

// SE(2) around the crossing, in time up to its limit.
std::shared_ptr<SpaceTimeStateSpace> SpaceOf(const Crossing& crossing,
                                             const PlanSettings& settings) {
  constexpr double kRoomM = 3;  // beside the straight way
  auto se2 = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  for (int axis = 0; axis < 2; ++axis) {
    bounds.setLow(axis, std::min(crossing.start_W[axis], crossing.goal_W[axis]) - kRoomM);
    bounds.setHigh(axis, std::max(crossing.start_W[axis], crossing.goal_W[axis]) + kRoomM);
  }
  se2->setBounds(bounds);
  return std::make_shared<SpaceTimeStateSpace>(
      se2, SpeedLimits{crossing.max_speed_mps, settings.max_turn_radps}, crossing.time_limit);
}

void SetSe2(ob::State* state, const Eigen::Vector2d& p_W, double yaw_rad) {
  auto* se2 = state->as<ob::SE2StateSpace::StateType>();
  se2->setXY(p_W.x(), p_W.y());
  se2->setYaw(yaw_rad);
}

CheckOptions CheckOptionsOf(const PlanSettings& settings, double inflation_mps) {
  CheckOptions options;
  options.unknown = UnknownPolicy::kTolerated;
  options.max_unknown_fraction = settings.max_unknown_fraction;
  options.inflation_mps = inflation_mps;
  options.inflate_moving_only = true;
  options.ignored_objects = settings.ignored_objects;
  return options;
}

absl::StatusOr<Plan> PlanWith(double inflation_mps,
                              const std::shared_ptr<const StateChecker>& checker,
                              const Crossing& crossing, const GroundPlane& ground,
                              const PlanSettings& settings) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  const auto space = SpaceOf(crossing, settings);
  PlanningOptions options;
  options.check = CheckOptionsOf(settings, inflation_mps);
  const auto mapping = StateMapping::Se2(
      checker->robot(), ground.Under(settings.ground_clearance_m), TimeSince{crossing.now});

  ob::ScopedState<> start(space);
  SetSe2(SpaceTimeStateSpace::SpacePart(start.get()), crossing.start_W, crossing.Yaw());
  SpaceTimeStateSpace::SetSeconds(start.get(), 0);
  ob::ScopedState<> goal(space->space());
  SetSe2(goal.get(), crossing.goal_W, crossing.Yaw());
  const auto setup = MakeSpaceTimeSetup(space, checker, mapping, options, start.get(), goal.get(),
                                        {.tolerance = 0.01});
  if (!setup.ok()) return setup.status();
  ob::IterationTerminationCondition enough(settings.iterations);
  const bool found = static_cast<bool>((*setup)->solve(enough));
  const StateQuery& query = *QueryOf(*(*setup)->getSpaceInformation());
  if (!query.first_error().ok()) return query.first_error();
  if (!found) return absl::NotFoundError("no path arrives in time");
  og::PathGeometric path = (*setup)->getSolutionPath();
  const PathCheck check = CheckPath(path, query);
  if (!check.free) return absl::InternalError("the path found does not pass its own check");
  // What is judged and drawn is the motion that was checked, step by step.
  path.interpolate(static_cast<unsigned int>(check.answers.size()));
  auto poses = TimedPoses(path, query.mapping());
  if (!poses.ok()) return poses.status();
  return Plan{(*setup)->getPlanner()->getName(),
              inflation_mps,
              *std::move(poses),
              check.unknown_fraction,
              checker->version(),
              check.answers.size()};
}

}  // namespace

absl::StatusOr<Plan> PlanCrossing(std::shared_ptr<const StateChecker> checker,
                                  const Crossing& crossing, const GroundPlane& ground,
                                  const PlanSettings& settings) {
  absl::StatusOr<Plan> plan = absl::NotFoundError("no inflation to plan with");
  for (const double inflation_mps : settings.inflations_mps) {
    plan = PlanWith(inflation_mps, checker, crossing, ground, settings);
    if (!absl::IsNotFound(plan.status())) break;
  }
  return plan;
}

absl::Status CheckRoom(const std::shared_ptr<const StateChecker>& checker, const Crossing& crossing,
                       const GroundPlane& ground, PlanSettings settings) {
  // What is hard to find without traffic is too tight to dodge it.
  settings.iterations = std::max(settings.iterations / 4, 1u);
  const std::vector<TimedPose> way = StraightWay(crossing, ground, settings.ground_clearance_m);
  const auto ends =
      checker->Check({{crossing.now, crossing.now}, {way.front().T_W_L, way.back().T_W_L}},
                     CheckOptionsOf(settings, 0));
  if (!ends.ok()) return ends.status();
  for (const int i : {0, 1}) {
    if (ends->answers[i].status == SpaceStatus::kFree) continue;
    return absl::FailedPreconditionError(absl::StrFormat("the static map reads %s at the %s",
                                                         ToString(ends->answers[i].status),
                                                         i == 0 ? "start" : "goal"));
  }
  const auto plan = PlanWith(0, checker, crossing, ground, settings);
  if (!absl::IsNotFound(plan.status())) return plan.status();
  return absl::FailedPreconditionError("the static map leaves no way through");
}

}  // namespace clearway::demo
