// The one interface through which robot states are checked: in-process, mirrored or remote.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/collision/robot.h"
#include "clearway/geometry/pose.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// A batch of robot states: a time each, and a pose T_W_L for each link.
struct StateBatch {
  std::vector<Time> times;
  std::vector<Pose> T_W_L;  // state-major: link l of state s is at s * (number of links) + l
};

// How unknown space counts. There is no default on the wire; here it is the safe one.
enum class UnknownPolicy { kBlocked, kFree, kTolerated };

// What a check takes into account, beside the scene. A plain value.
struct CheckOptions {
  UnknownPolicy unknown = UnknownPolicy::kBlocked;
  // For kTolerated: the share of the robot's volume that may be unknown. The volume is counted in
  // static voxels whose centre lies in the robot.
  double max_unknown_fraction = 0;
  // Declared free of unknown space (the robot's start, a blind zone); they hide no obstacle.
  std::vector<Aabb> known_free_W;

  double padding_m = 0;      // added all round the robot
  double inflation_mps = 0;  // added round each moving object per second after its t_k

  std::vector<ObjectId> ignored_objects;
  std::vector<std::pair<int, ObjectId>>
      allowed_contacts;  // (link, object); object 0 is the static map

  // If set, also the clearance, searched up to this distance.
  std::optional<double> clearance_up_to_m;
};

// INVALID_ARGUMENT naming the field and the limit.
absl::Status Validate(const CheckOptions& options, const Robot& robot);

struct StateAnswer {
  SpaceStatus status = SpaceStatus::kUnresolved;
  // Of what made the status: the lowest (link, object) in that order; object 0 is the static map.
  // -1 when the status is kFree.
  int link = -1;
  ObjectId object = kStaticLabel;
  // Share of the robot's volume in unknown space, 0 to 1, whatever the policy.
  double unknown_fraction = 0;
  // Distance to whatever the policy blocks, 0 in contact, at most clearance_up_to_m; set when asked
  // for.
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

  // INVALID_ARGUMENT for a batch whose arrays do not fit, poses that are not rigid, or options that
  // Validate refuses; a remote checker may also fail as its transport does. Whoever gets an error
  // must treat every state as not free.
  virtual absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                           const CheckOptions& options) const = 0;

  virtual const Robot& robot() const = 0;
  // The pinned version.
  virtual std::uint64_t version() const = 0;
  // Of the pinned version's newest frame.
  virtual Time stamp() const = 0;
};

}  // namespace clearway
