#include "clearway/planning/space_time_setup.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/planning/safe_interval_planner.h"

namespace clearway {

namespace ob = ompl::base;
namespace og = ompl::geometric;

absl::StatusOr<og::SimpleSetupPtr> MakeSpaceTimeSetup(
    const std::shared_ptr<SpaceTimeStateSpace>& space, std::shared_ptr<const StateChecker> checker,
    StateMapping mapping, PlanningOptions options, const ob::State* start,
    const ob::State* goal_part, const GoalOptions& goal_options) {
  if (space == nullptr) return absl::InvalidArgumentError("space: is null");
  // OMPL throws at limits that are none.
  if (auto status = Validate(*space); !status.ok()) return status;
  const auto si =
      MakeSpaceInformation(space, std::move(checker), std::move(mapping), std::move(options));
  if (!si.ok()) return si.status();
  if (start == nullptr) return absl::InvalidArgumentError("start: is null");
  const auto begin = QueryOf(**si)->mapping().TimeOf(start);
  if (!begin.ok()) return begin.status();
  if (const Time stamp = QueryOf(**si)->checker().stamp(); *begin < stamp) {
    return absl::InvalidArgumentError(absl::StrCat("start: is at ", ToNanoseconds(*begin),
                                                   " ns, in the past of the scene, which is of ",
                                                   ToNanoseconds(stamp)));
  }
  const auto problem = MakeSpaceTimeProblem(*si, start, goal_part, goal_options);
  if (!problem.ok()) return problem.status();
  auto setup = std::make_shared<og::SimpleSetup>(*si);
  setup->setPlanner(std::make_shared<SafeIntervalPlanner>(*si));
  setup->addStartState(ob::ScopedState<>(space, start));
  setup->setGoal((*problem)->getGoal());
  return setup;
}

}  // namespace clearway
