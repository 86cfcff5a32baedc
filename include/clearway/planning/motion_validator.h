// OMPL's motion validity over a StateChecker.
#pragma once

#include <ompl/base/MotionValidator.h>

#include <memory>
#include <utility>

#include "clearway/planning/state_query.h"

namespace clearway {

// Checks a whole motion with one call of the checker, at the steps of PlanningOptions. In
// space-time a motion that runs backwards in time or breaks a speed limit is invalid from its
// start. Any thread may call checkMotion; OMPL's counters are kept with atomic additions, but OMPL
// reads and resets them without, so do that between solves.
class SceneMotionValidator : public ompl::base::MotionValidator {
 public:
  SceneMotionValidator(const ompl::base::SpaceInformationPtr& si,
                       std::shared_ptr<const StateQuery> query);

  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  // If the motion is invalid, last_valid.second is the fraction of the last checked state before
  // the first that is not valid (0: none but s1, which is assumed valid), and last_valid.first,
  // unless null, becomes that state; it may be s1 or s2 itself. If it is valid, neither is touched.
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  // The fraction of the last valid state; 1 if all are.
  double ValidFraction(const ompl::base::State* s1, const ompl::base::State* s2) const;
  bool Count(bool valid) const;

  std::shared_ptr<const StateQuery> query_;
};

}  // namespace clearway
