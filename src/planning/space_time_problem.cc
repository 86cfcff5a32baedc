#include "clearway/planning/space_time_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "planning/tight_limit.h"

namespace clearway {

namespace ob = ompl::base;

namespace {

// OMPL takes what is not a number for within.
bool IsWithin(const ob::StateSpace& space, const ob::State* state) {
  std::vector<double> reals;
  space.copyToReals(reals, state);
  return std::ranges::all_of(reals, [](double real) { return std::isfinite(real); }) &&
         space.satisfiesBounds(state);
}

// In seconds of the space.
double LatestArrival(const SpaceTimeStateSpace& space, const GoalOptions& options,
                     double earliest_s) {
  if (!options.latest) return space.latest_s();
  return std::min(LatestSeconds(*options.latest, earliest_s), space.latest_s());
}

}  // namespace

GoalPoseBefore::GoalPoseBefore(const ob::SpaceInformationPtr& si, const ob::State* start,
                               const ob::State* goal_part, const GoalOptions& options)
    : ob::GoalSampleableRegion(si),
      space_time_(si->getStateSpace()->as<SpaceTimeStateSpace>()),
      goal_part_(space_time_->space()->cloneState(goal_part)),
      earliest_s_(SpaceTimeStateSpace::SecondsOf(start) +
                  space_time_->MinSeconds(SpaceTimeStateSpace::SpacePart(start), goal_part)),
      latest_s_(LatestArrival(*space_time_, options, earliest_s_)) {
  setThreshold(options.tolerance);
}

GoalPoseBefore::~GoalPoseBefore() { space_time_->space()->freeState(goal_part_); }

double GoalPoseBefore::distanceGoal(const ob::State* state) const {
  if (SpaceTimeStateSpace::SecondsOf(state) > latest_s_) return space_time_->UnreachableDistance();
  return space_time_->space()->distance(SpaceTimeStateSpace::SpacePart(state), goal_part_);
}

void GoalPoseBefore::sampleGoal(ob::State* state) const {
  space_time_->space()->copyState(SpaceTimeStateSpace::SpacePart(state), goal_part_);
  SpaceTimeStateSpace::SetSeconds(state, rng_.uniformReal(earliest_s_, latest_s_));
}

unsigned int GoalPoseBefore::maxSampleCount() const {
  return std::numeric_limits<unsigned int>::max();
}

absl::StatusOr<ob::ProblemDefinitionPtr> MakeSpaceTimeProblem(const ob::SpaceInformationPtr& si,
                                                              const ob::State* start,
                                                              const ob::State* goal_part,
                                                              const GoalOptions& options) {
  auto* space_time = dynamic_cast<SpaceTimeStateSpace*>(si->getStateSpace().get());
  if (space_time == nullptr) {
    return absl::InvalidArgumentError(
        absl::StrCat("si: space '", si->getStateSpace()->getName(), "' has no time component"));
  }
  if (auto status = Validate(*space_time); !status.ok()) return status;
  if (!(options.tolerance > 0)) {
    return absl::InvalidArgumentError(
        absl::StrCat("tolerance: is ", NumberText(options.tolerance), ", must be above 0"));
  }
  if (start == nullptr) return absl::InvalidArgumentError("start: is null");
  if (goal_part == nullptr) return absl::InvalidArgumentError("goal_part: is null");
  if (!IsWithin(*space_time, start)) {
    return absl::InvalidArgumentError("start: outside the space's bounds");
  }
  if (!IsWithin(*space_time->space(), goal_part)) {
    return absl::InvalidArgumentError("goal_part: outside the space's bounds");
  }
  const double arrival_s = SpaceTimeStateSpace::SecondsOf(start) +
                           space_time->MinSeconds(SpaceTimeStateSpace::SpacePart(start), goal_part);
  const double latest_s = LatestArrival(*space_time, options, arrival_s);
  if (!(arrival_s <= latest_s)) {
    return absl::InvalidArgumentError(absl::StrCat("goal_part: reached at full speed at ",
                                                   NumberText(arrival_s), " s, the limit is ",
                                                   NumberText(latest_s), " s"));
  }
  space_time->Focus(start, goal_part, latest_s);
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->addStartState(start);
  problem->setGoal(std::make_shared<GoalPoseBefore>(si, start, goal_part, options));
  return problem;
}

}  // namespace clearway
