#include "clearway/planning/solve_task.h"

#include <ompl/base/ScopedState.h>

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/collision/safe_intervals.h"
#include "clearway/planning/safe_interval_planner.h"
#include "clearway/planning/space_time_setup.h"
#include "planning/task_space.h"

namespace clearway {
namespace {

namespace ob = ompl::base;

// How finely paths are cut for Plan::motion where links go on curves.
constexpr double kLeg_m = 0.0125;

// A solve at work: the task, and OMPL's side of it.
class Work {
 public:
  static absl::StatusOr<std::unique_ptr<Work>> Of(const PlanTask& task,
                                                  std::shared_ptr<const StateChecker> checker) {
    std::unique_ptr<Work> work(new Work(task, checker));
    if (auto status = work->SetUp(); !status.ok()) return status;
    return work;
  }

  StateAnswer AtStart() const { return query_->CheckState(start_.get()); }
  absl::Status first_error() const { return query_->first_error(); }

  // Whether anything was found, if there was anything to try; each plan goes to `found`.
  bool Plan(const ob::PlannerTerminationCondition& until,
            const std::function<void(const clearway::Plan&)>& found) {
    bool any = false;
    setup_->getProblemDefinition()->setIntermediateSolutionCallback([&](const ob::Planner*,
                                                                        const std::vector<
                                                                            const ob::State*>&
                                                                            goal_to_start,
                                                                        ob::Cost) {
      absl::StatusOr<clearway::Plan> plan = PlanOf({goal_to_start.rbegin(), goal_to_start.rend()});
      if (!plan.ok() || !IsProved(plan->motion)) return;
      any = true;
      found(*plan);
    });
    setup_->setup();
    setup_->getPlanner()->solve(until);  // the set-up's own would print
    return any;
  }

  // What is in the way at the goal at all times at which it could be reached; none if it is free at
  // one of them.
  absl::StatusOr<std::optional<StateAnswer>> BlockerOfGoal() const {
    StateBatch goal;
    SpaceTimeStateSpace::SetSeconds(goal_.get(), EarliestArrival_s());
    if (auto status = query_->mapping().Append(goal_.get(), goal); !status.ok()) return status;
    const TimeInterval window{goal.times[0], task_.start_time + task_.time_limit};
    const auto free =
        FindSafeIntervals(*checker_, goal.T_W_L, window, {.check = task_.options.check});
    if (!free.ok()) return free.status();
    if (!(*free)[0].empty()) return std::nullopt;
    return query_->CheckState(goal_.get());
  }

 private:
  using State = ob::ScopedState<>;

  Work(const PlanTask& task, std::shared_ptr<const StateChecker> checker)
      : task_(task),
        checker_(std::move(checker)),
        space_(SpaceOf(task)),
        start_(space_),
        goal_(space_) {}

  absl::Status SetUp() {
    for (const auto& [values, state] : {std::pair{&task_.start, &start_}, {&task_.goal, &goal_}}) {
      WriteConfiguration(task_.space, *values, SpaceTimeStateSpace::SpacePart(state->get()));
      // Angles within a turn, quaternions of length 1 to the last digit: OMPL ends the program if
      // they are not.
      space_->enforceBounds(state->get());
      SpaceTimeStateSpace::SetSeconds(state->get(), 0);
    }
    if (EarliestArrival_s() > ToSeconds(task_.time_limit)) {
      return absl::OutOfRangeError(absl::StrCat("time_limit_s is ", ToSeconds(task_.time_limit),
                                                "; at full speed the goal is reached after ",
                                                EarliestArrival_s(), " s"));
    }
    PlanningOptions options;
    options.check = task_.options.check;
    options.contact_resolution_m = task_.options.contact_resolution_m;
    constexpr double kSame = 1e-6;  // goals are places, not regions
    auto setup = MakeSpaceTimeSetup(space_, checker_, MappingOf(task_, checker_->robot()), options,
                                    start_.get(), SpaceTimeStateSpace::SpacePart(goal_.get()),
                                    {.tolerance = kSame});
    if (!setup.ok()) return setup.status();
    setup_ = *std::move(setup);
    query_ = QueryOf(*setup_->getSpaceInformation());
    return absl::OkStatus();
  }

  double EarliestArrival_s() const {
    return space_->MinSeconds(SpaceTimeStateSpace::SpacePart(start_.get()),
                              SpaceTimeStateSpace::SpacePart(goal_.get()));
  }

  absl::StatusOr<clearway::Plan> PlanOf(const std::vector<const ob::State*>& states) const {
    clearway::Plan plan;
    for (const ob::State* state : states) {
      const absl::StatusOr<Time> time = query_->mapping().TimeOf(state);
      if (!time.ok()) return time.status();
      plan.times.push_back(*time);
      plan.configurations.push_back(
          ReadConfiguration(task_.space, SpaceTimeStateSpace::SpacePart(state)));
    }
    for (std::size_t i = 1; i < states.size(); ++i) {
      const auto leg = query_->MotionOf(states[i - 1], states[i], kLeg_m);
      if (!leg.ok()) return leg.status();
      Append(*leg, plan.motion);
    }
    return plan;
  }

  bool IsProved(const MotionBatch& motion) const {
    const auto reply = checker_->CheckMotions(motion, task_.options);
    return reply.ok() && reply->version == checker_->version() && reply->answers.size() == 1 &&
           reply->answers[0].status == SpaceStatus::kFree;
  }

  // Joins one motion's end to another's begin, which are the same state.
  void Append(const MotionBatch& leg, MotionBatch& motion) const {
    const std::size_t links = checker_->robot().links.size();
    if (!motion.times.empty()) {
      motion.times.pop_back();
      motion.T_W_L.resize(motion.T_W_L.size() - links);
      motion.deviations_m.resize(motion.T_W_L.size());
    }
    motion.times.insert(motion.times.end(), leg.times.begin(), leg.times.end());
    motion.T_W_L.insert(motion.T_W_L.end(), leg.T_W_L.begin(), leg.T_W_L.end());
    motion.deviations_m.insert(motion.deviations_m.end(), leg.deviations_m.begin(),
                               leg.deviations_m.end());
    motion.knot_counts = {motion.times.size()};
  }

  const PlanTask& task_;
  std::shared_ptr<const StateChecker> checker_;
  std::shared_ptr<SpaceTimeStateSpace> space_;
  State start_;
  mutable State goal_;  // its time is for those who ask
  ompl::geometric::SimpleSetupPtr setup_;
  const StateQuery* query_ = nullptr;
};

}  // namespace

absl::StatusOr<PlanOutcome> Solve(const PlanTask& task, std::shared_ptr<const StateChecker> checker,
                                  Duration budget, const std::function<void(const Plan&)>& found,
                                  const std::function<bool()>& cancelled) {
  const auto end = std::chrono::steady_clock::now() + budget;
  if (auto status = Validate(task, checker->robot()); !status.ok()) return status;
  if (task.start_time < checker->stamp()) {
    return absl::InvalidArgumentError(absl::StrCat("start_ns is ", ToNanoseconds(task.start_time),
                                                   ", in the past of the scene, which is of ",
                                                   ToNanoseconds(checker->stamp())));
  }
  const auto work = Work::Of(task, checker);
  if (!work.ok()) return work.status();
  PlanOutcome outcome;
  outcome.version = checker->version();
  outcome.stamp = checker->stamp();
  if (const StateAnswer start = (*work)->AtStart(); start.status != SpaceStatus::kFree) {
    outcome.status = PlanStatus::kStartBlocked;
    outcome.blocker = start;
    return outcome;
  }
  const ob::PlannerTerminationCondition until(
      [&] { return cancelled() || std::chrono::steady_clock::now() >= end; });
  if ((*work)->Plan(until, found)) {
    outcome.status = PlanStatus::kFound;
    return outcome;
  }
  if (auto error = (*work)->first_error(); !error.ok()) return error;
  const auto blocker = (*work)->BlockerOfGoal();
  if (!blocker.ok()) return blocker.status();
  if (*blocker) {
    outcome.status = PlanStatus::kGoalBlocked;
    outcome.blocker = **blocker;
  }
  return outcome;
}

}  // namespace clearway
