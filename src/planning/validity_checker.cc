#include "clearway/planning/validity_checker.h"

#include <utility>

namespace clearway {

namespace ob = ompl::base;

SceneValidityChecker::SceneValidityChecker(const ob::SpaceInformationPtr& si,
                                           std::shared_ptr<const StateQuery> query)
    : ob::StateValidityChecker(si), query_(std::move(query)) {
  specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE;
}

bool SceneValidityChecker::isValid(const ob::State* state) const {
  return query_->CheckState(state).status == SpaceStatus::kFree;
}

bool SceneValidityChecker::isValid(const ob::State* state, double& dist) const {
  const StateAnswer answer = query_->CheckClearance(state);
  const bool free = answer.status == SpaceStatus::kFree;
  dist = free ? answer.clearance_m.value_or(0) : 0;
  return free;
}

double SceneValidityChecker::clearance(const ob::State* state) const {
  double clearance_m = 0;
  isValid(state, clearance_m);
  return clearance_m;
}

}  // namespace clearway
