#include "clearway/planning/safe_interval_planner.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <limits>
#include <string>

#include "clearway/planning/space_time_problem.h"
#include "planning/interval_search.h"
#include "planning/roadmap.h"
#include "planning/timed_checks.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

// What is left of the way counts so much at first, and after each path a fourth of that.
constexpr double kGreedy = 16, kLessGreedy = 0.25;
// How many ways a search may ask about for each place before there had better be more places.
constexpr std::size_t kWaysEach = 100;
constexpr std::size_t kMostGoals = 10;
// An arrival that is no earlier than the one before by this is no news.
constexpr double kEarlier_s = 1e-3;

}  // namespace

struct SafeIntervalPlanner::Impl {
  Impl(const ob::SpaceInformationPtr& space_information, const SpaceTimeStateSpace& space_time)
      : si(space_information),
        space(space_time),
        roadmap(space_time),
        checks(space_information),
        search(space_time, roadmap, checks),
        sampler(space_time.space()->allocStateSampler()),
        there(si->allocState()) {}

  // Adds places that can be visited on the way to an arrival earlier than the best one. Whether any
  // was.
  bool AddPlaces(std::size_t count, const ob::PlannerTerminationCondition& until);
  void SamplePlace(ob::State* part);
  double ArrivalBy(const ob::State* part) const;
  // Whether an earlier arrival was found.
  bool Search(double weight, const ob::Goal& goal, const ob::PlannerTerminationCondition& until);
  void JoinAlongPath();
  bool GoalsAreTaken() const;
  std::shared_ptr<og::PathGeometric> Path() const;
  double Arrival() const {
    return path.empty() ? std::numeric_limits<double>::infinity() : path.back().arrival_s;
  }
  ob::State* At(std::size_t place, double seconds) const {
    space.space()->copyState(SpaceTimeStateSpace::SpacePart(there), roadmap.Place(place));
    SpaceTimeStateSpace::SetSeconds(there, seconds);
    return there;
  }
  ~Impl() {
    si->freeState(there);
    si->freeStates(shown);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  ob::SpaceInformationPtr si;
  const SpaceTimeStateSpace& space;
  Roadmap roadmap;
  TimedChecks checks;
  IntervalSearch search;
  ob::StateSamplerPtr sampler;
  ob::State* there;  // owned; of At
  ompl::RNG random;
  std::vector<std::pair<std::size_t, double>> starts;
  std::vector<std::size_t> goals;
  std::vector<Stay> path;         // the best so far
  std::vector<ob::State*> shown;  // owned; by getPlannerData
};

// The earliest arrival by way of the place, at full speed.
double SafeIntervalPlanner::Impl::ArrivalBy(const ob::State* part) const {
  double reached_s = std::numeric_limits<double>::infinity(), left_s = reached_s;
  for (const auto& [start, seconds] : starts) {
    reached_s = std::min(reached_s, seconds + space.MinSeconds(roadmap.Place(start), part));
  }
  for (const std::size_t goal : goals) {
    left_s = std::min(left_s, space.MinSeconds(part, roadmap.Place(goal)));
  }
  return reached_s + left_s;
}

// Once there is a path, every other place is near it.
void SafeIntervalPlanner::Impl::SamplePlace(ob::State* part) {
  constexpr double kNear = 0.05;  // of the space
  if (path.empty() || random.uniform01() < 0.5) return sampler->sampleUniform(part);
  const int stay = random.uniformInt(0, static_cast<int>(path.size()) - 1);
  sampler->sampleUniformNear(part, roadmap.Place(path[stay].place),
                             kNear * space.space()->getMaximumExtent());
}

bool SafeIntervalPlanner::Impl::AddPlaces(std::size_t count,
                                          const ob::PlannerTerminationCondition& until) {
  constexpr std::size_t kTriesEach = 100;
  ob::State* const part = space.space()->allocState();
  std::size_t added = 0;
  for (std::size_t tries = 0; added < count && tries < kTriesEach * count && !until(); ++tries) {
    SamplePlace(part);
    if (ArrivalBy(part) >= std::min(Arrival(), space.latest_s())) continue;
    roadmap.Add(part);
    ++added;
  }
  space.space()->freeState(part);
  return added > 0;
}

bool SafeIntervalPlanner::Impl::Search(double weight, const ob::Goal& goal,
                                       const ob::PlannerTerminationCondition& until) {
  std::vector<Stay> found = search.Find(
      {.starts = starts,
       .goals = goals,
       .arrived = [&](std::size_t place,
                      double arrival_s) { return goal.isSatisfied(At(place, arrival_s)); },
       .weight = weight,
       .earlier_than_s = Arrival() - kEarlier_s,
       .most_ways = kWaysEach * roadmap.size(),
       .cancelled = [&] { return until(); }});
  if (found.empty()) return false;
  path = std::move(found);
  return true;
}

// A way that leaves out places in between may be shorter.
void SafeIntervalPlanner::Impl::JoinAlongPath() {
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (std::size_t j = i + 2; j < path.size(); ++j) roadmap.Join(path[i].place, path[j].place);
  }
}

// Whenever one looks.
bool SafeIntervalPlanner::Impl::GoalsAreTaken() const {
  constexpr int kLooks = 100;
  for (int look = 0; look <= kLooks; ++look) {
    for (const std::size_t goal : goals) {
      if (si->isValid(At(goal, space.latest_s() * look / kLooks))) return false;
    }
  }
  return true;
}

std::shared_ptr<og::PathGeometric> SafeIntervalPlanner::Impl::Path() const {
  auto result = std::make_shared<og::PathGeometric>(si);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0 && path[i].departed_s > path[i - 1].arrival_s) {
      result->append(At(path[i - 1].place, path[i].departed_s));
    }
    result->append(At(path[i].place, path[i].arrival_s));
  }
  return result;
}

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

void SafeIntervalPlanner::clear() {
  ob::Planner::clear();
  impl_.reset();
  ShowProgress();
}

void SafeIntervalPlanner::ShowProgress() {
  progress_.arrival_s = impl_ ? impl_->Arrival() : std::numeric_limits<double>::infinity();
  progress_.places = impl_ ? impl_->roadmap.size() : 0;
  progress_.ways_asked = impl_ ? impl_->checks.ways_asked() : 0;
}

void SafeIntervalPlanner::setup() {
  ob::Planner::setup();
  if (dynamic_cast<const SpaceTimeStateSpace*>(si_->getStateSpace().get()) == nullptr) {
    throw ompl::Exception(getName(), "needs a SpaceTimeStateSpace");
  }
}

void SafeIntervalPlanner::AddStarts() {
  while (const ob::State* start = pis_.nextStart()) {
    const std::size_t place = impl_->roadmap.Add(SpaceTimeStateSpace::SpacePart(start));
    impl_->starts.emplace_back(place, SpaceTimeStateSpace::SecondsOf(start));
  }
}

// A place that may be reached at any time is taken as it is: OMPL would look whether it is free at
// a random one.
void SafeIntervalPlanner::AddGoals(const ob::PlannerTerminationCondition& until) {
  if (const auto* goal = dynamic_cast<const GoalPoseBefore*>(pdef_->getGoal().get())) {
    if (impl_->goals.empty()) impl_->goals.push_back(impl_->roadmap.Add(goal->goal_part()));
    return;
  }
  while (impl_->goals.size() < kMostGoals) {
    const ob::State* goal = impl_->goals.empty() ? pis_.nextGoal(until) : pis_.nextGoal();
    if (goal == nullptr) return;
    const ob::State* const part = SpaceTimeStateSpace::SpacePart(goal);
    for (const std::size_t known : impl_->goals) {
      if (impl_->space.space()->equalStates(part, impl_->roadmap.Place(known))) return;
    }
    impl_->goals.push_back(impl_->roadmap.Add(part));
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
  if (impl_->starts.empty()) return ob::PlannerStatus::INVALID_START;
  AddGoals(until);
  if (impl_->goals.empty()) return ob::PlannerStatus::INVALID_GOAL;
  bool more = true;
  for (double weight = kGreedy; more && !until();) {
    const bool earlier = impl_->Search(weight, *pdef_->getGoal(), until);
    ShowProgress();
    if (earlier) {
      AddSolution();
      impl_->JoinAlongPath();
      weight = std::max(1.0, kLessGreedy * weight);
    } else if (!until()) {
      more = impl_->AddPlaces(std::max<std::size_t>(first_batch_, impl_->roadmap.size()), until);
    }
  }
  if (!impl_->path.empty()) return ob::PlannerStatus::EXACT_SOLUTION;
  if (!more || impl_->GoalsAreTaken()) return ob::PlannerStatus::INVALID_GOAL;
  return ob::PlannerStatus::TIMEOUT;
}

void SafeIntervalPlanner::AddSolution() {
  const auto path = impl_->Path();
  const ob::OptimizationObjectivePtr objective = pdef_->getOptimizationObjective();
  ob::PlannerSolution solution(path);
  solution.setPlannerName(getName());
  solution.setOptimized(objective, path->cost(objective), false);
  pdef_->addSolutionPath(solution);
  if (const auto& report = pdef_->getIntermediateSolutionCallback()) {
    const std::vector<ob::State*>& states = path->getStates();
    report(this, {states.rbegin(), states.rend()}, path->cost(objective));
  }
}

void SafeIntervalPlanner::getPlannerData(ob::PlannerData& data) const {
  ob::Planner::getPlannerData(data);
  if (!impl_) return;
  const std::vector<Stay>& stays = impl_->search.stays();
  for (ob::State* state : impl_->shown) si_->freeState(state);
  impl_->shown.clear();
  const auto vertex = [&](int stay) {
    return ob::PlannerDataVertex(impl_->shown[static_cast<std::size_t>(stay)], stay);
  };
  for (int i = 0; i < static_cast<int>(stays.size()); ++i) {
    impl_->shown.push_back(si_->cloneState(impl_->At(stays[i].place, stays[i].arrival_s)));
    if (stays[i].before < 0) {
      data.addStartVertex(vertex(i));
    } else {
      data.addEdge(vertex(stays[i].before), vertex(i));
    }
  }
}

}  // namespace clearway
