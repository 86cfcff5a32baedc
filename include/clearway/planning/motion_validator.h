// OMPL's motion validity over a StateChecker.
#pragma once

#include <ompl/base/MotionValidator.h>

#include <memory>
#include <utility>

#include "clearway/planning/state_query.h"

namespace clearway {

// Proves a whole motion free with one call of the checker, or two (see StateQuery::ProveMotion):
// there is nothing between samples to miss. In space-time a motion that runs backwards in time or
// breaks a speed limit is invalid from its start. Any thread may call checkMotion; OMPL's counters
// are kept with atomic additions, but OMPL reads and resets them without, so do that between
// solves.
class SceneMotionValidator : public ompl::base::MotionValidator {
 public:
  SceneMotionValidator(const ompl::base::SpaceInformationPtr& si,
                       std::shared_ptr<const StateQuery> query);

  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  // If the motion is invalid, last_valid.second is the fraction up to which it is proved free (0:
  // nothing of it), and last_valid.first, unless null, becomes the state there; it may be s1 or s2
  // itself. If it is valid, neither is touched.
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& last_valid) const override;

 private:
  bool Count(bool valid) const;

  std::shared_ptr<const StateQuery> query_;
};

}  // namespace clearway
