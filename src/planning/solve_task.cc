#include "clearway/planning/solve_task.h"

#include <ompl/base/ScopedState.h>

#include <utility>

#include "clearway/collision/cancellable_checker.h"
#include "clearway/planning/safe_interval_planner.h"
#include "clearway/planning/space_information.h"
#include "clearway/planning/space_time_problem.h"
#include "clearway/planning/state_query.h"
#include "clearway/planning/task_setup.h"
#include "planning/task_space.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

// Less than this and nothing has to be driven: times are whole nanoseconds.
constexpr double kThere_s = 1e-6;
// How finely paths are cut for Plan::motion where links go on curves.
constexpr double kLeg_m = 0.0125;
// What is asked when the budget ends may take so much longer.
constexpr auto kGrace = std::chrono::milliseconds(100);

// A checker that ends within a question, if it is in this process.
std::shared_ptr<const StateChecker> EndingWhen(const std::function<bool()>& late,
                                               std::shared_ptr<const StateChecker> checker) {
  auto local = std::dynamic_pointer_cast<const SceneChecker>(checker);
  if (local == nullptr) return checker;
  return std::make_shared<CancellableChecker>(std::move(local), late);
}

// A solve at work: the task, and OMPL's side of it.
class Work {
 public:
  Work(const PlanTask& task, std::shared_ptr<const StateChecker> checker, og::SimpleSetupPtr setup)
      : task_(task),
        checker_(std::move(checker)),
        setup_(std::move(setup)),
        query_(*QueryOf(*setup_->getSpaceInformation())) {}

  StateAnswer AtStart() const {
    return query_.CheckState(setup_->getProblemDefinition()->getStartState(0));
  }
  absl::Status first_error() const { return query_.first_error(); }
  // The goal is where the start is.
  bool IsThere() const {
    const auto& space = *setup_->getStateSpace()->as<SpaceTimeStateSpace>();
    const ob::State* const start = setup_->getProblemDefinition()->getStartState(0);
    return space.MinSeconds(SpaceTimeStateSpace::SpacePart(start),
                            setup_->getGoal()->as<GoalPoseBefore>()->goal_part()) < kThere_s;
  }

  // What the planner says; each plan goes to `found`.
  PlanStatus Plan(const ob::PlannerTerminationCondition& until,
                  const std::function<void(const clearway::Plan&)>& found) {
    bool any = false;
    setup_->getProblemDefinition()->setIntermediateSolutionCallback(
        [&](const ob::Planner*, const std::vector<const ob::State*>& goal_to_start, ob::Cost) {
          const absl::StatusOr<clearway::Plan> plan =
              PlanOf({goal_to_start.rbegin(), goal_to_start.rend()});
          if (!plan.ok() || !IsProved(plan->motion)) return;
          any = true;
          found(*plan);
        });
    setup_->setup();
    const ob::PlannerStatus end = setup_->getPlanner()->solve(until);  // the set-up's would print
    if (any) return PlanStatus::kFound;
    if (end == ob::PlannerStatus::INVALID_GOAL) return PlanStatus::kGoalBlocked;
    return end == ob::PlannerStatus::ABORT ? PlanStatus::kNoTimeToSpare : PlanStatus::kNotFound;
  }

  // As of the last motion that was asked about.
  Duration horizon() const { return horizon_; }

  // At the goal when it can first be reached.
  StateAnswer AtGoal() const {
    const auto& space = *setup_->getStateSpace()->as<SpaceTimeStateSpace>();
    const ob::State* const start = setup_->getProblemDefinition()->getStartState(0);
    ob::ScopedState<> state(setup_->getStateSpace(), start);
    ob::State* const part = SpaceTimeStateSpace::SpacePart(state.get());
    space.space()->copyState(part, setup_->getGoal()->as<GoalPoseBefore>()->goal_part());
    SpaceTimeStateSpace::SetSeconds(state.get(),
                                    space.MinSeconds(SpaceTimeStateSpace::SpacePart(start), part));
    return query_.CheckState(state.get());
  }

 private:
  absl::StatusOr<clearway::Plan> PlanOf(const std::vector<const ob::State*>& states) const {
    clearway::Plan plan;
    for (const ob::State* state : states) {
      const absl::StatusOr<Time> time = query_.mapping().TimeOf(state);
      if (!time.ok()) return time.status();
      plan.times.push_back(*time);
      plan.configurations.push_back(
          ReadConfiguration(task_.space, SpaceTimeStateSpace::SpacePart(state)));
    }
    for (std::size_t i = 1; i < states.size(); ++i) {
      const auto leg = query_.MotionOf(states[i - 1], states[i], kLeg_m);
      if (!leg.ok()) return leg.status();
      Append(*leg, plan.motion);
    }
    return plan;
  }

  bool IsProved(const MotionBatch& motion) {
    const auto reply = checker_->CheckMotions(motion, task_.options);
    if (reply.ok()) horizon_ = reply->horizon;
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
  og::SimpleSetupPtr setup_;
  const StateQuery& query_;  // of the setup
  Duration horizon_{};
};

}  // namespace

absl::StatusOr<PlanOutcome> Solve(const PlanTask& asked,
                                  std::shared_ptr<const StateChecker> checker, Duration budget,
                                  const std::function<void(const Plan&)>& found,
                                  const std::function<bool()>& cancelled) {
  const auto end = std::chrono::steady_clock::now() + budget;
  const PlanTask task = WithClearance(asked, *checker);
  bool late = false;  // a question was not answered for lack of time
  checker = EndingWhen(
      [&] {
        late = late || cancelled() || std::chrono::steady_clock::now() >= end + kGrace;
        return late;
      },
      std::move(checker));
  auto setup = MakeTaskSetup(task, checker);
  if (!setup.ok()) return setup.status();
  Work work(task, checker, *std::move(setup));
  PlanOutcome outcome;
  outcome.version = checker->version();
  outcome.stamp = checker->stamp();
  outcome.inflation_mps = task.options.check.inflation_mps;
  outcome.bound_multiple = task.options.check.bound_multiple;
  const StateAnswer start = work.AtStart();
  if (late) return outcome;
  if (auto error = work.first_error(); !error.ok()) return error;
  if (start.status != SpaceStatus::kFree) {
    outcome.status = PlanStatus::kStartBlocked;
    outcome.blocker = start;
    return outcome;
  }
  if (work.IsThere()) {
    outcome.status = PlanStatus::kFound;
    found({{task.start_time}, {NormalizedConfiguration(task.space, task.start)}, {}});
    return outcome;
  }
  const ob::PlannerTerminationCondition until(
      [&] { return cancelled() || std::chrono::steady_clock::now() >= end; });
  const PlanStatus status = work.Plan(until, found);
  outcome.horizon = work.horizon();
  if (late && status != PlanStatus::kFound) return outcome;
  outcome.status = status;
  if (status == PlanStatus::kFound) return outcome;
  if (auto error = work.first_error(); !error.ok()) return error;
  if (status == PlanStatus::kGoalBlocked) outcome.blocker = work.AtGoal();
  return outcome;
}

}  // namespace clearway
