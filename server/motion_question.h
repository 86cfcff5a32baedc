// What CheckMotions and WatchMotions are asked.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/collision/motion.h"
#include "clearway/v1/check_service.pb.h"
#include "server/core.h"

namespace clearway {

struct MotionQuestion {
  std::string robot_id;
  std::shared_ptr<const PreparedRobot> robot;
  MotionOptions options;
  MotionBatch motions;
};

// Checked as far as can be without a scene. NOT_FOUND for a robot that is not known.
absl::StatusOr<MotionQuestion> ReadMotionQuestion(const v1::CheckMotionsRequest& proto,
                                                  ServerCore& core);

}  // namespace clearway
