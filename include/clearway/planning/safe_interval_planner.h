// Planning in space-time over safe intervals.
#pragma once

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/Planner.h>

#include <atomic>
#include <limits>
#include <memory>
#include <vector>

#include "clearway/planning/space_time.h"

namespace clearway {

// The time that a path takes, in seconds: of two, the better one arrives first.
class EarliestArrivalObjective : public ompl::base::OptimizationObjective {
 public:
  explicit EarliestArrivalObjective(const ompl::base::SpaceInformationPtr& si);
  ompl::base::Cost stateCost(const ompl::base::State* state) const override;
  ompl::base::Cost motionCost(const ompl::base::State* from,
                              const ompl::base::State* to) const override;
};

// Finds the path that arrives first, in any SpaceTimeStateSpace, whose times the search reasons
// about instead of sampling them: places are sampled alone. At each place the robot may wait as
// long as that is free, its safe interval; from it every neighbouring place is left for as soon as
// the way there, at full speed, is seen to be free (what is in the way is looked at every 0.3 s,
// later after ever more, at goals every 20 ms: shorter gaps may be missed). (Phillips and
// Likhachev, "SIPP: Safe Interval Path Planning for Dynamic Environments", 2011; on random places
// as Karaman and Frazzoli's PRM*, "Sampling-based Algorithms for Optimal Motion Planning", 2011, in
// batches and with the most promising edge first as Gammell et al.'s BIT*, 2015.)
//
// A first path is looked for greedily among the first batch of places; where that finds none, by
// the earliest arrival among these and then among more, and greedily where that gives up. After a
// path earlier ones are looked for, with more and more places, of which only those are kept that an
// earlier arrival can visit. A latest time that leaves little to spare makes the first
// path harder to find, not easier: there is none to be improved until one is in time. A robot is at
// rest or at full speed: it can stop and start at once.
//
// Over the space information of MakeSpaceInformation motions are proved and waits are proved safe
// intervals. Over any other the motion validator is asked; it must refuse motions backwards in
// time. States are of that space: starts are taken as they are; a goal counts as
// reached when its isSatisfied says so at the time of arrival at the place of one of its states or,
// after a wait there, at the time of that state; of a GoalPoseBefore the times count for nothing.
//
// One thread. Progress properties "best cost REAL" (the arrival, seconds of the space), "places
// INTEGER", "edges checked INTEGER". Continues where it stopped if solve is called again without
// clear().
class SafeIntervalPlanner : public ompl::base::Planner {
 public:
  explicit SafeIntervalPlanner(const ompl::base::SpaceInformationPtr& si);
  ~SafeIntervalPlanner() override;

  // How many places the first batch has; each later one has as many as there are then.
  void SetFirstBatch(unsigned int places) { first_batch_ = places; }
  unsigned int GetFirstBatch() const { return first_batch_; }

  // INVALID_START if none is valid; INVALID_GOAL if none is valid or, where they may be reached at
  // any time, none was free when it was looked at, every 20 ms for an hour and then ever more
  // seldom, as of other places; ABORT if the straight way is not free and no
  // place is found by way of which the latest time leaves more, or if the space is so wide (more
  // than some 1e5 times what can be reached in time) that no place within reach is found; TIMEOUT
  // if `until` held before a path was found; else EXACT_SOLUTION, with the earliest arrival found
  // when `until` held, or with one that no path can beat or that is good enough for the problem's
  // objective (its cost threshold). Gives the problem the objective EarliestArrivalObjective if it
  // has none.
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& until) override;
  void clear() override;
  // Another problem than the one before is begun anew.
  void setProblemDefinition(const ompl::base::ProblemDefinitionPtr& problem) override;
  void setup() override;
  // Of the search that found the path, or of the last one if none did: the stays, at the times of
  // arrival, and the ways between them. The states are the planner's, until clear().
  void getPlannerData(ompl::base::PlannerData& data) const override;

 private:
  struct Impl;
  void AddStarts();
  void AddGoals(const ompl::base::PlannerTerminationCondition& until);
  // Whether an earlier arrival was found among the places that there are.
  bool FindEarlier(const ompl::base::PlannerTerminationCondition& until);
  bool AddSolution();

  std::unique_ptr<Impl> impl_;
  // For other threads, as of the last search.
  struct Progress {
    std::atomic<double> arrival_s = std::numeric_limits<double>::infinity();
    std::atomic<std::size_t> places = 0, ways_asked = 0;
  };
  void ShowProgress();

  Progress progress_;
  unsigned int first_batch_ = 200;
};

}  // namespace clearway
