// A checker that stops when nobody waits for its answers any more.
#pragma once

#include <memory>
#include <utility>

#include "clearway/collision/scene_checker.h"
#include "server/core.h"

namespace clearway {

// Answers as the checker does until `gone`, then with CANCELLED. One thread.
class CancellableChecker : public StateChecker {
 public:
  CancellableChecker(std::shared_ptr<const SceneChecker> checker, Gone gone)
      : checker_(std::move(checker)), gone_(std::move(gone)) {}

  absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                   const CheckOptions& options) const override {
    return checker_->Check(states, options, gone_);
  }
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions& options) const override {
    return checker_->CheckMotions(motions, options, gone_);
  }
  const Robot& robot() const override { return checker_->robot(); }
  std::uint64_t version() const override { return checker_->version(); }
  Time stamp() const override { return checker_->stamp(); }

 private:
  std::shared_ptr<const SceneChecker> checker_;
  Gone gone_;
};

}  // namespace clearway
