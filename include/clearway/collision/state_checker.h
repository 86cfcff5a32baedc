// The one interface through which robot states and motions are checked: in-process, mirrored or
// remote.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/collision/check_options.h"
#include "clearway/collision/motion.h"
#include "clearway/collision/robot.h"
#include "clearway/geometry/pose.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// A batch of robot states: a time each, and a pose T_W_L for each link.
struct StateBatch {
  std::vector<Time> times;
  std::vector<Pose> T_W_L;  // state-major: link l of state s is at s * (number of links) + l
};

struct StateAnswer {
  SpaceStatus status = SpaceStatus::kUnresolved;
  // Of what made the status: the lowest (link, object) in that order; object 0 is the static map.
  // -1 when the status is kFree.
  int link = -1;
  ObjectId object = kStaticLabel;
  // Share of the robot's volume in unknown space, 0 to 1; 1 out of bounds. A robot that holds no
  // voxel's centre is judged by the voxels at its shapes' centres. Set when asked for.
  std::optional<double> unknown_fraction;
  // Distance from the padded robot to whatever the policy blocks (not to the bounds), 0 in contact
  // and out of bounds, at most clearance_up_to_m; set when asked for.
  std::optional<double> clearance_m;
};

struct CheckReply {
  std::uint64_t version = 0;  // that every answer was computed on
  Time stamp;
  std::vector<StateAnswer> answers;  // one per state, in their order
};

// Answers for one robot on one scene version, pinned for the checker's life. Any number of threads
// may call any method.
class StateChecker {
 public:
  virtual ~StateChecker() = default;

  // INVALID_ARGUMENT for a batch whose arrays do not fit, poses that are not finite or not rigid,
  // times beyond 2^62 ns, or options that Validate refuses; a remote checker may also fail as its
  // transport does. Whoever gets an error must treat every state as not free.
  virtual absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                           const CheckOptions& options) const = 0;

  // Whether each motion is free, by proof, or where it is in contact first. Errors as of Check.
  virtual absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                                   const MotionOptions& options) const = 0;

  virtual const Robot& robot() const = 0;
  // The pinned version.
  virtual std::uint64_t version() const = 0;
  // Of the pinned version's newest frame.
  virtual Time stamp() const = 0;
};

}  // namespace clearway
