#include "closed_loop/way_to_goal.h"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>

#include <vector>

#include "clearway/planning/space_time_setup.h"

namespace clearway::closed_loop {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

std::shared_ptr<SpaceTimeStateSpace> SpaceOf(const WayQuestion& question) {
  auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);
  for (unsigned int axis : {0u, 1u}) {
    bounds.setLow(axis, question.errand.area_W.min[axis]);
    bounds.setHigh(axis, question.errand.area_W.max[axis]);
  }
  plane->setBounds(bounds);
  return std::make_shared<SpaceTimeStateSpace>(
      plane, SpeedLimits{.translation_mps = question.errand.carrier.max_speed_mps},
      question.latest);
}

TimedPath ToTimedPath(const og::PathGeometric& path, Time epoch) {
  std::vector<TimedPath::Knot> knots;
  for (std::size_t i = 0; i < path.getStateCount(); ++i) {
    const ob::State* const state = path.getState(static_cast<unsigned int>(i));
    const auto& p_W =
        *SpaceTimeStateSpace::SpacePart(state)->as<ob::RealVectorStateSpace::StateType>();
    const Time time = epoch + FromSeconds(SpaceTimeStateSpace::SecondsOf(state));
    if (knots.empty() || time > knots.back().time) knots.push_back({time, {p_W[0], p_W[1]}});
  }
  return TimedPath(std::move(knots));
}

}  // namespace

std::optional<TimedPath> FindWay(const std::shared_ptr<const StateChecker>& checker,
                                 const WayQuestion& question, const CheckOptions& options) {
  const auto space = SpaceOf(question);
  const auto mapping =
      StateMapping::R2(checker->robot(), question.errand.carrier.ground,
                       TimeSince{question.start.time}, question.errand.carrier.yaw_rad);
  ob::ScopedState<> start(space), goal(space);
  start = std::vector<double>{question.start.p_W.x(), question.start.p_W.y(), 0};
  goal = std::vector<double>{question.errand.goal_W.x(), question.errand.goal_W.y(), 0};
  const auto setup = MakeSpaceTimeSetup(
      space, checker, mapping, {.check = options, .contact_resolution_m = 0.05}, start.get(),
      SpaceTimeStateSpace::SpacePart(goal.get()), {.tolerance = 0.01});
  if (!setup.ok()) return std::nullopt;  // the start is outside, or the goal too far
  ob::IterationTerminationCondition enough(question.iterations);
  const bool found = (*setup)->solve(enough) == ob::PlannerStatus::EXACT_SOLUTION;
  if (!found) return std::nullopt;
  return ToTimedPath((*setup)->getSolutionPath(), question.start.time);
}

}  // namespace clearway::closed_loop
