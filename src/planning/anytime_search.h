// Earlier and earlier arrivals over more and more places.
#pragma once

#include <ompl/base/Goal.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/RandomNumbers.h>

#include <limits>
#include <memory>
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
  // False if it is one already.
  bool AddGoal(const ompl::base::State* part);
  std::size_t goals() const { return goals_.size(); }

  // Adds places that can be visited on the way to an arrival earlier than the best one. False
  // if there are none.
  bool AddPlaces(std::size_t count, const ompl::base::PlannerTerminationCondition& until);
  // Whether an earlier arrival was found. `weight`: of what is left of the way.
  bool Search(double weight, const ompl::base::Goal& goal,
              const ompl::base::PlannerTerminationCondition& until);
  void JoinAlongPath();

  bool found() const { return !path_.empty(); }
  double Arrival() const {
    return path_.empty() ? std::numeric_limits<double>::infinity() : path_.back().arrival_s;
  }
  std::shared_ptr<ompl::geometric::PathGeometric> Path() const;
  // Whether no goal is free, whenever one looks.
  bool GoalsAreTaken();

  std::size_t places() const { return roadmap_.size(); }
  std::size_t ways_asked() const { return checks_.ways_asked(); }
  // Of the last search, and the state of its begin; valid until the next one is asked for.
  const std::vector<Stay>& stays() const { return search_.stays(); }
  const ompl::base::State* BeginOf(const Stay& stay) const {
    return At(stay.place, stay.arrival_s);
  }

 private:
  ompl::base::State* At(std::size_t place, double seconds) const;
  void SamplePlace(ompl::base::State* part);
  void SampleNearPlaces(ompl::base::State* part);
  double ArrivalBy(const ompl::base::State* part) const;

  ompl::base::SpaceInformationPtr si_;
  const SpaceTimeStateSpace& space_;
  Roadmap roadmap_;
  TimedChecks checks_;
  IntervalSearch search_;
  ompl::base::StateSamplerPtr sampler_;
  ompl::base::State* there_;  // owned; of At
  ompl::RNG random_;
  std::vector<std::pair<std::size_t, double>> starts_;
  std::vector<std::size_t> goals_;
  std::vector<Stay> path_;  // the best so far
};

}  // namespace clearway
