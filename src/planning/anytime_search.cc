#include "planning/anytime_search.h"

#include <algorithm>
#include <cmath>

#include "planning/tight_limit.h"

namespace clearway {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

// How many ways a search may ask about for each place before there had better be more places: to
// try them all takes longer than to find a path among twice as many.
constexpr std::size_t kWaysEach = 8;
// An arrival that is no earlier than the one before by this is no news.
constexpr double kEarlier_s = 1e-3;

}  // namespace

AnytimeSearch::AnytimeSearch(const ob::SpaceInformationPtr& si, const SpaceTimeStateSpace& space)
    : si_(si),
      space_(space),
      roadmap_(space),
      checks_(si),
      search_(space, roadmap_, checks_),
      sampler_(space.space()->allocStateSampler()),
      there_(si->allocState()),
      latest_s_(space.latest_s()) {}

AnytimeSearch::~AnytimeSearch() { si_->freeState(there_); }

void AnytimeSearch::AddStart(const ob::State* part, double seconds) {
  starts_.emplace_back(roadmap_.Add(part), seconds);
}

std::size_t AnytimeSearch::GoalPlace(const ob::State* part) {
  for (const std::size_t known : goals_) {
    if (space_.space()->equalStates(part, roadmap_.Place(known))) return known;
  }
  goals_.push_back(roadmap_.Add(part));
  return goals_.back();
}

void AnytimeSearch::AddGoal(const ob::State* part) { GoalPlace(part); }

bool AnytimeSearch::AddGoalAt(const ob::State* part, double seconds) {
  const std::pair goal{GoalPlace(part), seconds};
  if (std::ranges::find(timed_goals_, goal) != timed_goals_.end()) return false;
  timed_goals_.push_back(goal);
  std::ranges::sort(timed_goals_);
  return true;
}

std::optional<double> AnytimeSearch::Arrives(const ob::Goal& goal, std::size_t place, double from_s,
                                             double until_s) const {
  if (goal.isSatisfied(At(place, std::min(from_s, latest_s_)))) return from_s;
  for (const auto& [timed, seconds] : timed_goals_) {
    if (timed != place || seconds < from_s || seconds > until_s) continue;
    if (goal.isSatisfied(At(place, seconds))) return seconds;
  }
  return std::nullopt;
}

ob::State* AnytimeSearch::At(std::size_t place, double seconds) const {
  space_.space()->copyState(SpaceTimeStateSpace::SpacePart(there_), roadmap_.Place(place));
  SpaceTimeStateSpace::SetSeconds(there_, seconds);
  return there_;
}

// The earliest arrival by way of the place, at full speed.
double AnytimeSearch::ArrivalBy(const ob::State* part) const {
  double reached_s = std::numeric_limits<double>::infinity(), left_s = reached_s;
  for (const auto& [start, seconds] : starts_) {
    reached_s = std::min(reached_s, seconds + space_.MinSeconds(roadmap_.Place(start), part));
  }
  for (const std::size_t goal : goals_) {
    left_s = std::min(left_s, space_.MinSeconds(part, roadmap_.Place(goal)));
  }
  return reached_s + left_s;
}

// Once there is a path, a few places are near it. Not more: an earlier arrival is more often on
// another side of what moves than near the path.
void AnytimeSearch::SamplePlace(ob::State* part) {
  constexpr double kShareNear = 0.1;
  constexpr double kNear = 0.05;  // of the space
  if (path_.empty() || random_.uniform01() >= kShareNear) return sampler_->sampleUniform(part);
  const int stay = random_.uniformInt(0, static_cast<int>(path_.size()) - 1);
  sampler_->sampleUniformNear(part, roadmap_.Place(path_[stay].place),
                              kNear * space_.space()->getMaximumExtent());
}

// Near any place that is known, as near as its neighbours may be in a small corner of the space or
// in a large one.
void AnytimeSearch::SampleNearPlaces(ob::State* part) {
  constexpr double kNearest = 1e-5;  // of the space
  const int place = random_.uniformInt(0, static_cast<int>(roadmap_.size()) - 1);
  const double near = std::pow(kNearest, random_.uniform01());
  sampler_->sampleUniformNear(part, roadmap_.Place(place),
                              near * space_.space()->getMaximumExtent());
}

double AnytimeSearch::LeadingBy() const {
  double begin_s = kNever_s, arrival_s = kNever_s;
  for (const auto& [place, seconds] : starts_) begin_s = std::min(begin_s, seconds);
  for (const std::size_t goal : goals_) {
    arrival_s = std::min(arrival_s, ArrivalBy(roadmap_.Place(goal)));
  }
  const double allowed_s = latest_s_ - begin_s;
  const double leading_s = LeadingSeconds(allowed_s, arrival_s - begin_s);
  return leading_s > allowed_s ? std::min(space_.latest_s(), begin_s + leading_s) : latest_s_;
}

bool AnytimeSearch::AddPlaces(std::size_t count, const ob::PlannerTerminationCondition& until) {
  constexpr std::size_t kTriesEach = 100;
  const std::size_t tries = kTriesEach * count;
  const double leading_by_s = LeadingBy();
  if (leading_by_s > latest_s_ && !AddPlacesBy(latest_s_, 1, tries, until)) return false;
  return AddPlacesBy(leading_by_s, count, tries, until);
}

// Where hardly a place of the whole space can be visited in time, they are looked for near those
// that can.
bool AnytimeSearch::AddPlacesBy(double latest_s, std::size_t count, std::size_t most_tries,
                                const ob::PlannerTerminationCondition& until) {
  constexpr std::size_t kHardly = 20;
  ob::State* const part = space_.space()->allocState();
  std::size_t added = 0;
  for (std::size_t tries = 0; added < count && tries < most_tries; ++tries) {
    if (until()) break;
    if (tries < kHardly * (added + 1)) {
      SamplePlace(part);
    } else {
      SampleNearPlaces(part);
    }
    const double arrival_s = ArrivalBy(part);
    if (arrival_s > latest_s || arrival_s >= BestArrival()) continue;
    roadmap_.Add(part);
    ++added;
  }
  space_.space()->freeState(part);
  return added > 0 || until();
}

bool AnytimeSearch::Search(double weight, const ob::Goal& goal,
                           const ob::PlannerTerminationCondition& until) {
  const double leading_by_s = LeadingBy();
  const double just_later_s = std::nextafter(leading_by_s, 2 * leading_by_s);
  std::vector<Stay> found = search_.Find(
      {.starts = starts_,
       .goals = goals_,
       .arrives = [&](std::size_t place, double from_s,
                      double until_s) { return Arrives(goal, place, from_s, until_s); },
       .weight = weight,
       .earlier_than_s = std::min(BestArrival() - kEarlier_s, just_later_s),
       .most_ways = kWaysEach * roadmap_.size(),
       .cancelled = [&] { return until(); }});
  if (found.empty()) return false;
  path_ = std::move(found);
  found_in_ = search_.stays();
  LeaveOutDetours();
  return true;
}

bool AnytimeSearch::MayGoStraight(const Stay& from, const Stay& to) {
  const double depart_s = to.arrival_s - roadmap_.Seconds(from.place, to.place);
  return depart_s >= from.arrival_s && depart_s <= from.leave_by_s &&
         checks_.Way(roadmap_.Place(from.place), roadmap_.Place(to.place), depart_s, to.arrival_s)
             .free;
}

// The search asks for the arrival alone: where a robot has to wait anyhow, it may have been
// somewhere meanwhile.
void AnytimeSearch::LeaveOutDetours() {
  for (std::size_t i = 0; i + 2 < path_.size(); ++i) {
    for (std::size_t j = path_.size() - 1; j > i + 1; --j) {
      if (!MayGoStraight(path_[i], path_[j])) continue;
      path_[j].departed_s = path_[j].arrival_s - roadmap_.Seconds(path_[i].place, path_[j].place);
      const auto begin = path_.begin();
      path_.erase(begin + static_cast<std::ptrdiff_t>(i + 1),
                  begin + static_cast<std::ptrdiff_t>(j));
      break;
    }
  }
}

// A way that leaves out places in between may be shorter.
void AnytimeSearch::JoinAlongPath() {
  for (std::size_t i = 0; i < path_.size(); ++i) {
    for (std::size_t j = i + 2; j < path_.size(); ++j)
      roadmap_.Join(path_[i].place, path_[j].place);
  }
}

bool AnytimeSearch::GoalsAreTaken(const ob::PlannerTerminationCondition& until) {
  const std::function<bool()> cancelled = [&] { return until(); };
  return timed_goals_.empty() && std::ranges::all_of(goals_, [&](std::size_t goal) {
           const double reached_s = ArrivalBy(roadmap_.Place(goal));
           return search_.FreeFrom(goal, reached_s, &cancelled) > latest_s_;
         });
}

std::shared_ptr<og::PathGeometric> AnytimeSearch::Path() const {
  auto result = std::make_shared<og::PathGeometric>(si_);
  for (std::size_t i = 0; i < path_.size(); ++i) {
    if (i > 0 && path_[i].departed_s > path_[i - 1].arrival_s) {
      result->append(At(path_[i - 1].place, path_[i].departed_s));
    }
    result->append(At(path_[i].place, path_[i].arrival_s));
  }
  return result;
}

}  // namespace clearway
