#include "clearway/planning/earliest_arrival.h"

#include <ompl/util/Exception.h>

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/planning/space_information.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using PathPtr = std::shared_ptr<og::PathGeometric>;

absl::Status NoPath(const ob::Planner& planner) {
  std::string message = absl::StrCat(planner.getName(), ": no path found");
  const StateQuery* query = QueryOf(*planner.getSpaceInformation());
  if (query != nullptr && query->error_count() > 0) {
    absl::StrAppend(&message, "; ", query->error_count(),
                    " checks failed, the first: ", query->first_error().ToString());
  }
  return absl::NotFoundError(message);
}

// Goes from each state to the last one that can be reached directly.
PathPtr Straightened(const og::PathGeometric& path) {
  const ob::SpaceInformationPtr& si = path.getSpaceInformation();
  auto result = std::make_shared<og::PathGeometric>(si, path.getState(0));
  std::size_t at = 0;
  while (at + 1 < path.getStateCount()) {
    std::size_t next = path.getStateCount() - 1;
    while (next > at + 1 && !si->checkMotion(path.getState(at), path.getState(next))) --next;
    result->append(path.getState(next));
    at = next;
  }
  return result;
}

// Null if there is no exact solution.
PathPtr SolveOnce(ob::Planner& planner, const ob::ProblemDefinitionPtr& problem,
                  const ob::PlannerTerminationCondition& until) {
  planner.clear();
  planner.setProblemDefinition(problem);
  if (!planner.isSetup()) planner.setup();
  planner.solve(ob::plannerOrTerminationCondition(
      until, ob::PlannerTerminationCondition([&] { return problem->hasExactSolution(); })));
  if (!problem->hasExactSolution()) return nullptr;
  return Straightened(*problem->getSolutionPath()->as<og::PathGeometric>());
}

Duration ArrivalOf(og::PathGeometric& path) {
  return FromSeconds(SpaceTimeStateSpace::SecondsOf(path.getState(path.getStateCount() - 1)));
}

}  // namespace

absl::StatusOr<PathPtr> PlanEarliestArrival(const ob::PlannerPtr& planner, const ob::State* start,
                                            const ob::State* goal_part, GoalOptions options,
                                            const ob::PlannerTerminationCondition& until,
                                            Duration improvement) try {
  PathPtr best;
  while (true) {
    const auto problem =
        MakeSpaceTimeProblem(planner->getSpaceInformation(), start, goal_part, options);
    if (best == nullptr && !problem.ok()) return problem.status();
    if (!problem.ok() || until()) break;
    const PathPtr path = SolveOnce(*planner, *problem, until);
    if (path == nullptr) break;
    best = path;
    options.latest = ArrivalOf(*best) - improvement;
  }
  if (best == nullptr) return NoPath(*planner);
  return best;
} catch (const ompl::Exception& e) {
  return absl::InternalError(absl::StrCat(planner->getName(), ": OMPL: ", e.what()));
}

}  // namespace clearway
