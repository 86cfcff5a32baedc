// The state checker over a scene in this process.
#pragma once

#include <functional>
#include <memory>

#include "clearway/collision/motion.h"
#include "clearway/collision/prepared_robot.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// Checks states and motions against one snapshot: the local checker, and with a mirror's snapshot
// the mirrored one. FCL does shape against shape; an exception of it counts as contact.
class SceneChecker : public StateChecker {
 public:
  // What takes long is in `robot`: make it once, and a checker for each version of the scene.
  SceneChecker(ScenePtr scene, std::shared_ptr<const PreparedRobot> robot);
  // Prepares the robot, which must pass Validate, for itself alone.
  SceneChecker(ScenePtr scene, Robot robot);
  ~SceneChecker() override;

  absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                   const CheckOptions& options) const override;
  // Both with `cancelled` look at it every so often, within a state or motion too, and end with
  // CANCELLED soon after it has become true. It must then stay true.
  absl::StatusOr<CheckReply> Check(const StateBatch& states, const CheckOptions& options,
                                   const std::function<bool()>& cancelled) const;
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions& options) const override;
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions, const MotionOptions& options,
                                           const std::function<bool()>& cancelled) const;
  const Robot& robot() const override;
  std::uint64_t version() const override;
  Time stamp() const override;
  const SceneSnapshot& scene() const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace clearway
