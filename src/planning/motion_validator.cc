#include "clearway/planning/motion_validator.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace clearway {

namespace ob = ompl::base;

SceneMotionValidator::SceneMotionValidator(const ob::SpaceInformationPtr& si,
                                           std::shared_ptr<const StateQuery> query)
    : ob::MotionValidator(si), query_(std::move(query)) {}

bool SceneMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  // Bounds first: it saves a call of the checker.
  return Count(query_->space().satisfiesBounds(s2) && ValidFraction(s1, s2) >= 1);
}

bool SceneMotionValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                       std::pair<ob::State*, double>& last_valid) const {
  const double fraction = ValidFraction(s1, s2);
  if (fraction >= 1) return Count(true);
  last_valid.second = fraction;
  if (last_valid.first != nullptr) {
    query_->space().interpolate(s1, s2, fraction, last_valid.first);
  }
  return Count(false);
}

double SceneMotionValidator::ValidFraction(const ob::State* s1, const ob::State* s2) const {
  const std::vector<StateAnswer> answers = query_->CheckMotion(s1, s2);
  const auto invalid = std::ranges::find_if(
      answers, [](const StateAnswer& a) { return a.status != SpaceStatus::kFree; });
  return static_cast<double>(invalid - answers.begin()) / static_cast<double>(answers.size());
}

bool SceneMotionValidator::Count(bool valid) const {
  std::atomic_ref(valid ? valid_ : invalid_).fetch_add(1, std::memory_order_relaxed);
  return valid;
}

}  // namespace clearway
