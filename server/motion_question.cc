#include "server/motion_question.h"

#include "wire/check_wire.h"
#include "wire/motion_wire.h"
#include "wire/status.h"

namespace clearway {

absl::StatusOr<MotionQuestion> ReadMotionQuestion(const v1::CheckMotionsRequest& proto,
                                                  ServerCore& core) {
  const auto prepared = core.robots.Find(proto.robot_id());
  if (!prepared.ok()) return prepared.status();
  const Robot& robot = (*prepared)->robot();
  const ServerLimits& limits = core.config.limits;
  absl::StatusOr<MotionOptions> options = ReadMotionOptions(proto, limits);
  if (!options.ok()) return options.status();
  if (absl::Status status = Validate(options->check, robot); !status.ok()) {
    return WithFieldPrefix("options.", status);
  }
  if (absl::Status status = Validate(*options, robot); !status.ok()) return status;
  absl::StatusOr<MotionBatch> motions = ReadMotions(proto, robot.links.size(), limits);
  if (!motions.ok()) return motions.status();
  if (absl::Status status = Validate(*motions, robot); !status.ok()) return status;
  return MotionQuestion{proto.robot_id(), *prepared, *std::move(options), *std::move(motions)};
}

}  // namespace clearway
