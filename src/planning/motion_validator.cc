#include "clearway/planning/motion_validator.h"

#include <atomic>
#include <utility>

namespace clearway {

namespace ob = ompl::base;

SceneMotionValidator::SceneMotionValidator(const ob::SpaceInformationPtr& si,
                                           std::shared_ptr<const StateQuery> query)
    : ob::MotionValidator(si), query_(std::move(query)) {}

bool SceneMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  // Bounds first: it saves a call of the checker.
  return Count(query_->space().satisfiesBounds(s2) && query_->ProveMotion(s1, s2).free());
}

bool SceneMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                       std::pair<ob::State*, double>& last_valid) const {
  const MotionProof proof = query_->ProveMotion(s1, s2);
  if (proof.free()) return Count(true);
  last_valid.second = proof.free_fraction;
  if (last_valid.first != nullptr) {
    query_->space().interpolate(s1, s2, proof.free_fraction, last_valid.first);
  }
  return Count(false);
}

bool SceneMotionValidator::Count(bool valid) const {
  std::atomic_ref(valid ? valid_ : invalid_).fetch_add(1, std::memory_order_relaxed);
  return valid;
}

}  // namespace clearway
