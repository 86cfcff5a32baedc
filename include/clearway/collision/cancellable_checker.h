// A checker that stops when nobody waits for its answers any more.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "clearway/collision/scene_checker.h"

namespace clearway {

// Answers as the checker does until `cancelled` is true, then with CANCELLED. `cancelled` must then
// stay true. One thread.
class CancellableChecker : public StateChecker {
 public:
  CancellableChecker(std::shared_ptr<const SceneChecker> checker, std::function<bool()> cancelled)
      : checker_(std::move(checker)), cancelled_(std::move(cancelled)) {}

  absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                   const CheckOptions& options) const override {
    return checker_->Check(states, options, cancelled_);
  }
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions& options) const override {
    return checker_->CheckMotions(motions, options, cancelled_);
  }
  const Robot& robot() const override { return checker_->robot(); }
  std::uint64_t version() const override { return checker_->version(); }
  Time stamp() const override { return checker_->stamp(); }

 private:
  std::shared_ptr<const SceneChecker> checker_;
  std::function<bool()> cancelled_;
};

}  // namespace clearway
