// "Be at this pose, at any time before T": problems in space-time.
#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalSampleableRegion.h>

#include <memory>
#include <optional>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/planning/space_time.h"

namespace clearway {

struct GoalOptions {
  // Distance, as the space without time measures it, that counts as arrived.
  double tolerance = 0.1;
  // Arrival at this time of the space at the latest; none: at the space's own latest. One that
  // leaves little time to spare (less than twice what the straight way takes) is met sooner in a
  // space that goes on for longer: later paths, which are easier to find, lead to those in time.
  std::optional<Duration> latest = std::nullopt;
};

// A pose to be reached at any time from the earliest possible up to the latest allowed; goal states
// are sampled over that interval. One thread at a time may sample, as every OMPL goal.
class GoalPoseBefore : public ompl::base::GoalSampleableRegion {
 public:
  // The space of `si` is a SpaceTimeStateSpace; `start` is one of its states, `goal_part` a state
  // of its space without time. Both are copied.
  GoalPoseBefore(const ompl::base::SpaceInformationPtr& si, const ompl::base::State* start,
                 const ompl::base::State* goal_part, const GoalOptions& options);
  ~GoalPoseBefore() override;

  double distanceGoal(const ompl::base::State* state) const override;
  void sampleGoal(ompl::base::State* state) const override;
  unsigned int maxSampleCount() const override;

  // A state of the space without time.
  const ompl::base::State* goal_part() const { return goal_part_; }
  // When to arrive at the latest, in seconds of the space.
  double latest_s() const { return latest_s_; }

 private:
  const SpaceTimeStateSpace* space_time_;
  ompl::base::State* goal_part_;  // owned
  double earliest_s_;
  double latest_s_;
  mutable ompl::RNG rng_;
};

// The problem of going from `start` to the pose `goal_part`. Focuses the space's samples on it
// (SpaceTimeStateSpace::Focus), so one problem at a time per space. INVALID_ARGUMENT if the space
// has no time component, states are outside its bounds, or the goal cannot be reached in time at
// full speed.
absl::StatusOr<ompl::base::ProblemDefinitionPtr> MakeSpaceTimeProblem(
    const ompl::base::SpaceInformationPtr& si, const ompl::base::State* start,
    const ompl::base::State* goal_part, const GoalOptions& options);

}  // namespace clearway
