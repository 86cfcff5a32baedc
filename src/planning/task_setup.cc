#include "clearway/planning/task_setup.h"

#include <ompl/base/ScopedState.h>

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/planning/space_time_setup.h"
#include "planning/task_space.h"
#include "planning/tight_limit.h"

namespace clearway {

namespace ob = ompl::base;

absl::StatusOr<ompl::geometric::SimpleSetupPtr> MakeTaskSetup(
    const PlanTask& asked, const std::shared_ptr<const StateChecker>& checker) {
  const PlanTask task = WithClearance(asked, *checker);
  if (auto status = Validate(task, checker->robot()); !status.ok()) return status;
  if (task.start_time < checker->stamp()) {
    return absl::InvalidArgumentError(absl::StrCat("start_ns is ", ToNanoseconds(task.start_time),
                                                   ", in the past of the scene, which is of ",
                                                   ToNanoseconds(checker->stamp())));
  }
  const auto space = SpaceOf(task);
  ob::ScopedState<> start(space), goal(space);
  for (const auto& [values, state] : {std::pair{&task.start, &start}, {&task.goal, &goal}}) {
    WriteConfiguration(task.space, *values, SpaceTimeStateSpace::SpacePart(state->get()));
    // Angles within a turn, quaternions of length 1 to the last digit: OMPL ends the program if
    // they are not.
    space->enforceBounds(state->get());
    SpaceTimeStateSpace::SetSeconds(state->get(), 0);
  }
  const ob::State* const goal_part = SpaceTimeStateSpace::SpacePart(goal.get());
  const double arrival_s =
      space->MinSeconds(SpaceTimeStateSpace::SpacePart(start.get()), goal_part);
  const double latest_s = LatestSeconds(task.time_limit, arrival_s);
  if (arrival_s > latest_s) {
    return absl::InvalidArgumentError(
        absl::StrFormat("time_limit_s is %.13g; at full speed the goal is reached after %.13g s",
                        ToSeconds(task.time_limit), std::ceil(1e9 * arrival_s) / 1e9));
  }
  const double ever_s = ToSeconds(TimeFromNanoseconds(kFarthest_ns) - task.start_time);
  const double space_s = std::min(ever_s, LeadingSeconds(latest_s, arrival_s));
  space->as<ob::TimeStateSpace>(1)->setBounds(0, space_s);
  PlanningOptions options;
  options.check = task.options.check;
  options.contact_resolution_m = task.options.contact_resolution_m;
  constexpr double kSame = 1e-6;  // goals are places, not regions
  return MakeSpaceTimeSetup(space, checker, MappingOf(task, checker->robot()), options, start.get(),
                            goal_part, {.tolerance = kSame, .latest = task.time_limit});
}

}  // namespace clearway
