#include "clearway/planning/safe_interval_planner.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include "clearway/planning/space_time_problem.h"
#include "planning/anytime_search.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

// What is left of the way counts so much where a first path is looked for greedily.
constexpr double kGreedy = 16;
constexpr std::size_t kMostGoals = 10;
// Among fewer places, more of them find a way sooner than closer looks at what passes by.
constexpr std::size_t kManyPlaces = 1600;

}  // namespace

struct SafeIntervalPlanner::Impl {
  Impl(const ob::SpaceInformationPtr& space_information, const SpaceTimeStateSpace& space_time)
      : si(space_information), search(space_information, space_time) {}
  ~Impl() { si->freeStates(shown); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  ob::SpaceInformationPtr si;
  AnytimeSearch search;
  std::vector<ob::State*> shown;  // owned; by all calls of getPlannerData
  // Of them, those of the stays as they are now, if they were shown.
  std::optional<std::size_t> shown_from;
};

EarliestArrivalObjective::EarliestArrivalObjective(const ob::SpaceInformationPtr& si)
    : ob::OptimizationObjective(si) {
  description_ = "Earliest arrival";
}

ob::Cost EarliestArrivalObjective::stateCost(const ob::State*) const { return identityCost(); }

ob::Cost EarliestArrivalObjective::motionCost(const ob::State* from, const ob::State* to) const {
  return ob::Cost(SpaceTimeStateSpace::SecondsOf(to) - SpaceTimeStateSpace::SecondsOf(from));
}

SafeIntervalPlanner::SafeIntervalPlanner(const ob::SpaceInformationPtr& si)
    : ob::Planner(si, "SafeInterval") {
  specs_.optimizingPaths = true;
  specs_.directed = true;
  specs_.canReportIntermediateSolutions = true;
  declareParam<unsigned int>("first_batch", this, &SafeIntervalPlanner::SetFirstBatch,
                             &SafeIntervalPlanner::GetFirstBatch, "1:1:100000");
  addPlannerProgressProperty("best cost REAL",
                             [this] { return std::to_string(progress_.arrival_s); });
  addPlannerProgressProperty("places INTEGER", [this] { return std::to_string(progress_.places); });
  addPlannerProgressProperty("edges checked INTEGER",
                             [this] { return std::to_string(progress_.ways_asked); });
}

SafeIntervalPlanner::~SafeIntervalPlanner() = default;

void SafeIntervalPlanner::setProblemDefinition(const ob::ProblemDefinitionPtr& problem) {
  if (problem != pdef_) clear();
  ob::Planner::setProblemDefinition(problem);
}

void SafeIntervalPlanner::clear() {
  ob::Planner::clear();
  impl_.reset();
  ShowProgress();
}

void SafeIntervalPlanner::ShowProgress() {
  progress_.arrival_s = impl_ ? impl_->search.Arrival() : std::numeric_limits<double>::infinity();
  progress_.places = impl_ ? impl_->search.places() : 0;
  progress_.ways_asked = impl_ ? impl_->search.ways_asked() : 0;
}

void SafeIntervalPlanner::setup() {
  ob::Planner::setup();
  if (dynamic_cast<const SpaceTimeStateSpace*>(si_->getStateSpace().get()) == nullptr) {
    throw ompl::Exception(getName(), "needs a SpaceTimeStateSpace");
  }
}

void SafeIntervalPlanner::AddStarts() {
  while (const ob::State* start = pis_.nextStart()) {
    impl_->search.AddStart(SpaceTimeStateSpace::SpacePart(start),
                           SpaceTimeStateSpace::SecondsOf(start));
  }
}

// A place that may be reached at any time is taken as it is: OMPL would look whether it is free at
// a random one.
void SafeIntervalPlanner::AddGoals(const ob::PlannerTerminationCondition& until) {
  if (const auto* goal = dynamic_cast<const GoalPoseBefore*>(pdef_->getGoal().get())) {
    impl_->search.AddGoal(goal->goal_part());
    impl_->search.ArriveBy(goal->latest_s());
    return;
  }
  while (impl_->search.timed_goals() < kMostGoals) {
    const ob::State* goal = impl_->search.goals() == 0 ? pis_.nextGoal(until) : pis_.nextGoal();
    if (goal == nullptr) return;
    if (!impl_->search.AddGoalAt(SpaceTimeStateSpace::SpacePart(goal),
                                 SpaceTimeStateSpace::SecondsOf(goal))) {
      return;
    }
  }
}

ob::PlannerStatus SafeIntervalPlanner::solve(const ob::PlannerTerminationCondition& until) {
  checkValidity();
  if (!pdef_->hasOptimizationObjective()) {
    pdef_->setOptimizationObjective(std::make_shared<EarliestArrivalObjective>(si_));
  }
  if (!impl_) {
    impl_ = std::make_unique<Impl>(si_, *si_->getStateSpace()->as<SpaceTimeStateSpace>());
  }
  AddStarts();
  if (!impl_->search.has_start()) return ob::PlannerStatus::INVALID_START;
  AddGoals(until);
  if (impl_->search.goals() == 0) return ob::PlannerStatus::INVALID_GOAL;
  if (!impl_->search.found() && impl_->search.GoalsAreTaken(until)) {
    return ob::PlannerStatus::INVALID_GOAL;
  }
  // After the first path the same places are searched for the best one; after that they yield no
  // more.
  bool more = true;
  // Somebody may have taken it away since the last solve.
  bool enough = impl_->search.found() && !pdef_->hasExactSolution() && AddSolution();
  impl_->shown_from.reset();
  while (more && !enough && !until()) {
    const bool first = !impl_->search.led();
    const bool earlier = FindEarlier(until);
    ShowProgress();
    if (earlier) {
      enough = impl_->search.found() && AddSolution();
      impl_->search.JoinAlongPath();
      if (first) continue;
    }
    if (!earlier && impl_->search.places() >= kManyPlaces) impl_->search.LookFiner();
    if (!enough && !until()) {
      more = impl_->search.AddPlaces(std::max<std::size_t>(first_batch_, impl_->search.places()),
                                     until);
    }
  }
  if (impl_->search.found()) return ob::PlannerStatus::EXACT_SOLUTION;
  if (!more) return ob::PlannerStatus::ABORT;
  return ob::PlannerStatus::TIMEOUT;
}

// Where there is an easy way, a greedy search finds it soonest, among few places. Where there is
// not, it may spend all that it may ask on dead ends near the goal, the more the denser the places
// are; one that is not greedy comes by the other ways, too, or soon knows that there are none.
bool SafeIntervalPlanner::FindEarlier(const ob::PlannerTerminationCondition& until) {
  AnytimeSearch& search = impl_->search;
  const auto find = [&](double weight) {
    return !until() && search.Search(weight, *pdef_->getGoal(), until);
  };
  if (search.led()) return find(1);
  const bool few = search.places() < 2 * first_batch_;
  if (few) return find(kGreedy) || find(1);
  return find(1) || (!search.exhausted() && find(kGreedy));
}

// Whether the objective asks for no better one.
bool SafeIntervalPlanner::AddSolution() {
  const auto path = impl_->search.Path();
  const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
  ob::PlannerSolution solution(path);
  solution.setPlannerName(getName());
  const ob::Cost cost = path->cost(objective);
  const bool enough = objective->isSatisfied(cost);
  solution.setOptimized(objective, cost, enough);
  pdef_->addSolutionPath(solution);
  if (const auto& report = pdef_->getIntermediateSolutionCallback()) {
    const std::vector<ob::State*>& states = path->getStates();
    report(this, {states.rbegin(), states.rend()}, cost);
  }
  return enough;
}

void SafeIntervalPlanner::getPlannerData(ob::PlannerData& data) const {
  ob::Planner::getPlannerData(data);
  if (!impl_) return;
  const std::vector<Stay>& stays = impl_->search.stays();
  if (!impl_->shown_from) {
    impl_->shown_from = impl_->shown.size();  // earlier data may still be in use
    for (const Stay& stay : stays)
      impl_->shown.push_back(si_->cloneState(impl_->search.BeginOf(stay)));
  }
  const auto state = [&](int stay) {
    return impl_->shown[*impl_->shown_from + static_cast<std::size_t>(stay)];
  };
  const auto vertex = [&](int stay) { return ob::PlannerDataVertex(state(stay), stay); };
  for (int i = 0; i < static_cast<int>(stays.size()); ++i) {
    if (stays[i].before < 0) {
      data.addStartVertex(vertex(i));
    } else {
      data.addEdge(vertex(stays[i].before), vertex(i));
    }
    if (pdef_->getGoal()->isSatisfied(state(i))) data.markGoalState(state(i));
  }
}

}  // namespace clearway
