// Earlier and earlier arrivals over more and more places.
#pragma once

#include <ompl/base/Goal.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "planning/interval_search.h"
#include "planning/roadmap.h"
#include "planning/timed_checks.h"

namespace clearway {

// What SafeIntervalPlanner does from solve to solve: a roadmap, what was asked about it, and the
// best path so far. One thread.
class AnytimeSearch {
 public:
  AnytimeSearch(const ompl::base::SpaceInformationPtr& si, const SpaceTimeStateSpace& space);
  ~AnytimeSearch();
  AnytimeSearch(const AnytimeSearch&) = delete;
  AnytimeSearch& operator=(const AnytimeSearch&) = delete;

  void AddStart(const ompl::base::State* part, double seconds);
  bool has_start() const { return !starts_.empty(); }
  // No path that arrives later is given. Where that leaves little time to spare, later ones are
  // looked for too: bettered, they become paths in time.
  void ArriveBy(double latest_s) { latest_s_ = std::min(latest_s_, latest_s); }
  // To be at the place when the goal says so.
  void AddGoal(const ompl::base::State* part);
  // The same, and it may do so at that time only. False if that is known.
  bool AddGoalAt(const ompl::base::State* part, double seconds);
  std::size_t goals() const { return goals_.size(); }
  std::size_t timed_goals() const { return timed_goals_.size(); }

  // Adds places that can be visited on the way to an arrival earlier than the best one. False
  // if there are none.
  bool AddPlaces(std::size_t count, const ompl::base::PlannerTerminationCondition& until);
  // Whether an earlier arrival was found, be it late. `weight`: of what is left of the way.
  bool Search(double weight, const ompl::base::Goal& goal,
              const ompl::base::PlannerTerminationCondition& until);
  // Whether the last search ended because there was no way left to ask about.
  bool exhausted() const { return search_.exhausted(); }
  void JoinAlongPath();
  // From now on shorter times in which places and ways are free are found; what was in the way is
  // looked at again. False if that was done as finely as it is worth.
  bool LookFiner() { return search_.LookFiner(); }

  bool found() const { return led() && path_.back().arrival_s <= latest_s_; }
  // Whether there is a path at all: one that is late leads to those in time.
  bool led() const { return !path_.empty(); }
  double Arrival() const { return found() ? BestArrival() : kNever_s; }
  std::shared_ptr<ompl::geometric::PathGeometric> Path() const;
  // Whether no goal is free, whenever it is looked at from when it can be reached on. False if that
  // is not known by then, or of some goals times are given, when they are.
  bool GoalsAreTaken(const ompl::base::PlannerTerminationCondition& until);

  std::size_t places() const { return roadmap_.size(); }
  std::size_t ways_asked() const { return checks_.ways_asked(); }
  // Of the search that found the best path; without a path, of the last one.
  const std::vector<Stay>& stays() const { return led() ? found_in_ : search_.stays(); }
  // Valid until the next one is asked for.
  const ompl::base::State* BeginOf(const Stay& stay) const {
    return At(stay.place, stay.arrival_s);
  }

 private:
  static constexpr double kNever_s = std::numeric_limits<double>::infinity();

  double BestArrival() const { return led() ? path_.back().arrival_s : kNever_s; }
  // A path that arrives until then may lead to one in time, or is one.
  double LeadingBy() const;
  // At most `count` on the way to an arrival until then. False if none is found.
  bool AddPlacesBy(double latest_s, std::size_t count, std::size_t most_tries,
                   const ompl::base::PlannerTerminationCondition& until);
  ompl::base::State* At(std::size_t place, double seconds) const;
  void SamplePlace(ompl::base::State* part);
  void SampleNearPlaces(ompl::base::State* part);
  double ArrivalBy(const ompl::base::State* part) const;
  std::size_t GoalPlace(const ompl::base::State* part);
  // Of the best path: whether the robot may wait at one stay and go straight on to a later one.
  bool MayGoStraight(const Stay& from, const Stay& to);
  void LeaveOutDetours();
  std::optional<double> Arrives(const ompl::base::Goal& goal, std::size_t place, double from_s,
                                double until_s) const;

  ompl::base::SpaceInformationPtr si_;
  const SpaceTimeStateSpace& space_;
  Roadmap roadmap_;
  TimedChecks checks_;
  IntervalSearch search_;
  ompl::base::StateSamplerPtr sampler_;
  ompl::base::State* there_;  // owned; of At
  ompl::RNG random_;
  double latest_s_;
  std::vector<std::pair<std::size_t, double>> starts_;
  std::vector<std::size_t> goals_;
  std::vector<std::pair<std::size_t, double>> timed_goals_;  // of goals_, with times
  std::vector<Stay> path_;                                   // the best so far, be it late
  std::vector<Stay> found_in_;                               // all of the search that found it
};

}  // namespace clearway
