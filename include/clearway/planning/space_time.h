// A state space with time: what planners that plan around moving objects search.
#pragma once

#include <ompl/base/StateSpace.h>
#include <ompl/base/spaces/TimeStateSpace.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"

namespace clearway {

// How fast a state may change. A limit applies to the matching parts of the space: the norm of an
// R^n part's change (for an arm, of its joint vector, in radians), and the angle of an SO(2) or
// SO(3) part's change.
struct SpeedLimits {
  double translation_mps = std::numeric_limits<double>::infinity();
  double rotation_radps = std::numeric_limits<double>::infinity();
  // Of the single axes of an R^n part, as an arm's joints; empty: none has a limit of its own.
  std::vector<double> axes_per_s = {};
};

// The product of an OMPL space (R^n, SE(2), SE(3), or a compound of R^n, SO(2) and SO(3)) and time
// in seconds. Linear interpolation: a motion between two states runs at constant speed. Any thread
// may call const methods; set it up from one.
//
// Time has a direction, so this is no metric space: the distance is asymmetric
// (hasSymmetricDistance is false), and so are motions and their cost (hasSymmetricInterpolate is
// false, which RRT* reads as "check both ways").
//
// Of OMPL's planners, those that grow one tree from the start along the direction of motion plan in
// it: RRT, RRT*, RRT#, LBTRRT, EST, ProjEST, KPIECE1, PDST, SST, STRIDE. Those that grow a second
// tree from the goal or search an implicit graph do not: RRTConnect and BIT* may not come back, and
// PRM's undirected roadmap yields paths that run back in time (CheckPath tells).
class SpaceTimeStateSpace : public ompl::base::CompoundStateSpace {
 public:
  // Times run from 0 to `latest`, seconds after whatever epoch the caller chooses (TimeSince).
  // latest > 0 and limits > 0 (see Validate), of as many axes as R^n has. The distance weighs a
  // metre (or radian, as `space` does) as `1 - time_weight` and a second as `time_weight`.
  SpaceTimeStateSpace(ompl::base::StateSpacePtr space, SpeedLimits limits, Duration latest,
                      double time_weight = 0.5);

  static double SecondsOf(const ompl::base::State* state);
  static void SetSeconds(ompl::base::State* state, double seconds);
  static const ompl::base::State* SpacePart(const ompl::base::State* state);
  static ompl::base::State* SpacePart(ompl::base::State* state);

  const ompl::base::StateSpacePtr& space() const { return components_[0]; }
  const SpeedLimits& limits() const { return limits_; }
  double latest_s() const;

  // The least time, in seconds, in which the limits allow to go from one state of space() to
  // another.
  double MinSeconds(const ompl::base::State* from_part, const ompl::base::State* to_part) const;
  // Whether `to` is later by MinSeconds at least (up to rounding: a part in a million). A state
  // reaches itself.
  bool CanReach(const ompl::base::State* from, const ompl::base::State* to) const;

  // Restricts uniform samples to what can be reached from `start` and can still reach the pose
  // `goal_part` by `latest_s`. Copies both states.
  void Focus(const ompl::base::State* start, const ompl::base::State* goal_part, double latest_s);
  // The interval of times at which a state of space() can be visited under Focus; empty (first >
  // second) if at none.
  std::pair<double, double> VisitableSeconds(const ompl::base::State* part) const;
  // Under Focus: writes the place at `fraction` of the straight way from start to goal and returns
  // true; else false.
  bool OnStraightWay(double fraction, ompl::base::State* part) const;
  // How far that is, as space() measures it; 0 without Focus.
  double StraightLength() const;

  // Unreachable: far above every extent, yet finite, so that a planner that steps a part of the way
  // to an unreachable state proposes a motion that the motion validator refuses (with infinity it
  // would step 0 / 0 or insert the state it stands on again and again).
  double UnreachableDistance() const;

  double distance(const ompl::base::State* from, const ompl::base::State* to) const override;
  bool isMetricSpace() const override { return false; }
  bool hasSymmetricDistance() const override { return false; }
  bool hasSymmetricInterpolate() const override { return false; }
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override;
  // The space's default projection (else its first two coordinates) and time, for KPIECE and
  // others.
  void registerProjections() override;
  // Without the checks that only a metric passes: symmetry, triangle inequality, bounded distance.
  using ompl::base::CompoundStateSpace::sanityChecks;
  void sanityChecks() const override;

 private:
  struct StateDeleter {
    ompl::base::StateSpacePtr space;
    void operator()(ompl::base::State* state) const { space->freeState(state); }
  };
  using OwnedState = std::unique_ptr<ompl::base::State, StateDeleter>;

  SpeedLimits limits_;
  double focus_start_s_ = 0;
  double focus_latest_s_;
  OwnedState focus_start_part_;
  OwnedState focus_goal_part_;
};

// INVALID_ARGUMENT naming what planners cannot work with: limits that are not above 0, of more or
// fewer axes than R^n has, a latest time that is not above 0 or above 3e9 s, bounds of R^n that are
// not finite, not ascending or more than 1e9 apart.
absl::Status Validate(const SpaceTimeStateSpace& space);

}  // namespace clearway
