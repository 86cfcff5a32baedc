// OMPL states put to a StateChecker.
#pragma once

#include <ompl/base/StateSpace.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "absl/status/status.h"
#include "clearway/collision/state_checker.h"
#include "clearway/planning/planning_options.h"
#include "clearway/planning/state_mapping.h"

namespace clearway {

// What is proved of a whole motion. A plain value.
struct MotionProof {
  MotionAnswer answer;  // if no time passes, its times are not the world's: see free_fraction
  // Of the motion, proved free from its start on; 1 only if all of it is.
  double free_fraction = 0;

  bool free() const { return answer.status == SpaceStatus::kFree; }
};

// Checks OMPL states of one space with one StateChecker, so on one scene version. Every failure
// makes kUnresolved answers (not free) and is counted. Any thread may call any method.
class StateQuery {
 public:
  // The mapping must fit the space, the options the checker's robot (see MakeSpaceInformation).
  StateQuery(ompl::base::StateSpacePtr space, std::shared_ptr<const StateChecker> checker,
             StateMapping mapping, PlanningOptions options);

  // Both: kOutOfBounds, without asking the checker, for a state outside the space's bounds.
  StateAnswer CheckState(const ompl::base::State* state) const;
  // With StateAnswer::clearance_m, up to PlanningOptions::clearance_up_to_m.
  StateAnswer CheckClearance(const ompl::base::State* state) const;

  // The place of a SpaceTimeStateSpace's state at other times, with one call of the checker.
  std::vector<StateAnswer> CheckPlace(const ompl::base::State* state,
                                      const std::vector<double>& seconds) const;

  // Cuts the motion into n equal parts as PlanningOptions asks and checks the states at fractions
  // 1/n, 2/n, ..., 1 with one call of the checker: n >= 1 answers. A motion that cannot be checked
  // (its time runs backwards or the speed limits are broken, among others) gives one kUnresolved.
  // `times`, if not null, gets the answers' times.
  std::vector<StateAnswer> CheckMotion(const ompl::base::State* from, const ompl::base::State* to,
                                       std::vector<Time>* times = nullptr) const;

  // Whether all of the motion is free, by proof: one call of the checker, or two for a robot whose
  // links go on curves. A motion that cannot be checked is kUnresolved, as above; one that ends
  // outside the space's bounds is kOutOfBounds if it is free up to there.
  MotionProof ProveMotion(const ompl::base::State* from, const ompl::base::State* to) const;

  // What is proved: one motion of the links, in legs of leg_m where they go on curves.
  absl::StatusOr<MotionBatch> MotionOf(const ompl::base::State* from, const ompl::base::State* to,
                                       double leg_m) const;

  const ompl::base::StateSpace& space() const { return *space_; }
  const StateChecker& checker() const { return *checker_; }
  const StateMapping& mapping() const { return mapping_; }
  const PlanningOptions& options() const { return options_; }

  // Failures so far, and the first of them (OK if there was none). A plan found in spite of
  // failures is still free; a plan not found may be due to them.
  std::int64_t error_count() const { return error_count_.load(); }
  absl::Status first_error() const;

 private:
  StateAnswer CheckOne(const ompl::base::State* state, const CheckOptions& options) const;
  std::vector<StateAnswer> Answer(const StateBatch& batch, const CheckOptions& options) const;
  std::vector<StateAnswer> Unresolved(std::size_t size, const absl::Status& why) const;
  MotionProof Prove(MotionBatch motion) const;
  double FractionWithinBounds(const ompl::base::State* from, const ompl::base::State* to) const;
  void CountError(const absl::Status& why) const;
  absl::Status WrongVersion(std::uint64_t answered) const;
  double StepCount(const ompl::base::State* from, const ompl::base::State* to) const;

  ompl::base::StateSpacePtr space_;
  std::shared_ptr<const StateChecker> checker_;
  StateMapping mapping_;
  PlanningOptions options_;
  CheckOptions clearance_options_;
  MotionOptions motion_options_;
  mutable std::atomic<std::int64_t> error_count_ = 0;
  mutable std::mutex mutex_;
  mutable absl::Status first_error_;  // guarded by mutex_
};

}  // namespace clearway
