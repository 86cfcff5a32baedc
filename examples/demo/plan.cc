#include "demo/plan.h"

#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"
#include "clearway/planning/path_check.h"
#include "clearway/planning/space_information.h"
#include "clearway/planning/space_time.h"
#include "clearway/planning/space_time_problem.h"
#include "demo/corridor_sampler.h"

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
  auto space = std::make_shared<SpaceTimeStateSpace>(
      se2, SpeedLimits{crossing.max_speed_mps, settings.max_turn_radps}, crossing.time_limit);
  space->setStateSamplerAllocator([crossing](const ob::StateSpace* sampled) {
    return std::make_shared<CorridorSampler>(static_cast<const SpaceTimeStateSpace*>(sampled),
                                             crossing);
  });
  return space;
}

void SetSe2(ob::State* state, const Eigen::Vector2d& p_W, double yaw_rad) {
  auto* se2 = state->as<ob::SE2StateSpace::StateType>();
  se2->setXY(p_W.x(), p_W.y());
  se2->setYaw(yaw_rad);
}

// Leaves out states between which the robot can drive at constant speed.
og::PathGeometric Straightened(const ob::SpaceInformationPtr& si, const og::PathGeometric& path) {
  og::PathGeometric result(si);
  for (std::size_t at = 0; at < path.getStateCount();) {
    result.append(path.getState(at));
    std::size_t next = path.getStateCount() - 1;
    while (next > at + 1 && !si->checkMotion(path.getState(at), path.getState(next))) --next;
    if (at + 1 == path.getStateCount()) break;
    at = next;
  }
  return result;
}

double ArrivalSeconds(og::PathGeometric& path) {
  return SpaceTimeStateSpace::SecondsOf(path.getStates().back());
}

// The first path that RRT finds that arrives by `latest`. NOT_FOUND after `iterations`.
absl::StatusOr<og::PathGeometric> FirstPath(const ob::SpaceInformationPtr& si,
                                            const ob::State* start, const ob::State* goal,
                                            Duration latest, unsigned int iterations) {
  const auto problem = MakeSpaceTimeProblem(si, start, goal, {.tolerance = 0.01, .latest = latest});
  if (!problem.ok()) return absl::NotFoundError(problem.status().message());
  og::RRT planner(si);
  planner.setRange(5);  // long: most crossings are a few straight motions
  planner.setGoalBias(0.15);
  planner.setProblemDefinition(*problem);
  planner.setup();
  ob::IterationTerminationCondition enough(iterations);
  const ob::PlannerStatus status = planner.solve(enough);
  const absl::Status error = QueryOf(*si)->first_error();
  if (!error.ok()) return error;
  if (status != ob::PlannerStatus::EXACT_SOLUTION) {
    return absl::NotFoundError(absl::StrFormat("no plan in %d iterations", iterations));
  }
  return Straightened(si, *(*problem)->getSolutionPath()->as<og::PathGeometric>());
}

// Looks for earlier and earlier arrivals, until one is not found.
absl::StatusOr<og::PathGeometric> EarlyPath(const ob::SpaceInformationPtr& si,
                                            const ob::State* start, const ob::State* goal,
                                            const PlanSettings& settings, Duration latest) {
  constexpr double kEarlierS = 0.4;
  auto best = FirstPath(si, start, goal, latest, settings.iterations);
  while (best.ok()) {
    auto earlier = FirstPath(si, start, goal, FromSeconds(ArrivalSeconds(*best) - kEarlierS),
                             settings.iterations / 4);
    if (!earlier.ok()) {
      if (!absl::IsNotFound(earlier.status())) return earlier.status();
      break;
    }
    best = std::move(earlier);
  }
  return best;
}

}  // namespace

CheckOptions CheckOptionsOf(const PlanSettings& settings) {
  CheckOptions options;
  options.unknown = UnknownPolicy::kTolerated;
  options.max_unknown_fraction = settings.max_unknown_fraction;
  options.inflation_mps = settings.inflation_mps;
  options.ignored_objects = settings.ignored_objects;
  return options;
}

absl::StatusOr<Plan> PlanCrossing(std::shared_ptr<const StateChecker> checker,
                                  const Crossing& crossing, const GroundPlane& ground,
                                  const PlanSettings& settings) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  const auto space = SpaceOf(crossing, settings);
  const Ground under{[ground](double x_m, double y_m) { return ground.HeightM(x_m, y_m); },
                     settings.ground_clearance_m};
  PlanningOptions options;
  options.check = CheckOptionsOf(settings);
  const auto si = MakeSpaceInformation(
      space, checker, StateMapping::Se2(checker->robot(), under, TimeSince{crossing.now}), options);
  if (!si.ok()) return si.status();

  ob::ScopedState<> start(space);
  SetSe2(SpaceTimeStateSpace::SpacePart(start.get()), crossing.start_W, crossing.Yaw());
  SpaceTimeStateSpace::SetSeconds(start.get(), 0);
  ob::ScopedState<> goal(space->space());
  SetSe2(goal.get(), crossing.goal_W, crossing.Yaw());
  const auto path = EarlyPath(*si, start.get(), goal.get(), settings, crossing.time_limit);
  if (!path.ok()) return path.status();
  const PathCheck check = CheckPath(*path, *QueryOf(**si));
  if (!check.free) return absl::InternalError("the path found does not pass its own check");
  auto poses = TimedPoses(*path, QueryOf(**si)->mapping());
  if (!poses.ok()) return poses.status();
  return Plan{"RRT", *std::move(poses), check.unknown_fraction, checker->version(),
              check.answers.size()};
}

absl::Status CheckStaticRoom(std::shared_ptr<const StateChecker> checker, const Crossing& crossing,
                             const GroundPlane& ground, const std::vector<ObjectId>& objects,
                             PlanSettings settings) {
  settings.ignored_objects = objects;
  settings.iterations = std::max(settings.iterations / 4, 1u);  // without traffic it is easy
  const std::vector<TimedPose> way = StraightWay(crossing, ground, settings.ground_clearance_m);
  const auto ends =
      checker->Check({{way.front().time, way.back().time}, {way.front().T_W_L, way.back().T_W_L}},
                     CheckOptionsOf(settings));
  if (!ends.ok()) return ends.status();
  for (const int i : {0, 1}) {
    if (ends->answers[i].status == SpaceStatus::kFree) continue;
    return absl::FailedPreconditionError(absl::StrFormat("the static map reads %s at the %s",
                                                         ToString(ends->answers[i].status),
                                                         i == 0 ? "start" : "goal"));
  }
  const auto plan = PlanCrossing(std::move(checker), crossing, ground, settings);
  if (!absl::IsNotFound(plan.status())) return plan.status();
  return absl::FailedPreconditionError("the static map leaves no way through");
}

}  // namespace clearway::demo
