// OMPL's state validity over a StateChecker.
#pragma once

#include <ompl/base/StateValidityChecker.h>

#include <memory>

#include "clearway/planning/state_query.h"

namespace clearway {

// A state is valid if it is within the space's bounds and its answer is kFree; any failure makes it
// invalid (see StateQuery::first_error). Any thread may call any method. One call of the checker
// per state: a remote one pays a round trip for each.
class SceneValidityChecker : public ompl::base::StateValidityChecker {
 public:
  SceneValidityChecker(const ompl::base::SpaceInformationPtr& si,
                       std::shared_ptr<const StateQuery> query);

  bool isValid(const ompl::base::State* state) const override;
  // `dist` as clearance() gives it; one call of the checker for both.
  bool isValid(const ompl::base::State* state, double& dist) const override;
  // Metres to whatever the policy blocks, at most PlanningOptions::clearance_up_to_m; 0 for a state
  // that is not valid.
  double clearance(const ompl::base::State* state) const override;
  using ompl::base::StateValidityChecker::clearance;
  using ompl::base::StateValidityChecker::isValid;

  const StateQuery& query() const { return *query_; }

 private:
  std::shared_ptr<const StateQuery> query_;
};

}  // namespace clearway
