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

// How space that the static map has never observed counts. There is no default on the wire; here it
// is the safe one.
//
// kBlocked: every unobserved voxel is an obstacle, with padding, as an occupied one is.
// kFree: none is. kTolerated: unobserved voxels are no obstacles, but the share of the robot's own
// volume (without padding) that lies in them is limited.
enum class UnknownPolicy { kBlocked, kFree, kTolerated };

// What a check takes into account, beside the scene. A plain value.
struct CheckOptions {
  UnknownPolicy unknown = UnknownPolicy::kBlocked;
  // For kTolerated: the share of the robot's volume that may be unknown. The volume is counted in
  // static voxels whose centre lies in the robot.
  double max_unknown_fraction = 0;
  // Whether answers carry the share of unknown space whatever the policy; with kTolerated they do.
  // It costs a look at every voxel of the robot.
  bool with_unknown_fraction = false;
  // Voxels whose centre lies in one of these are not unknown (the robot's start, a blind zone); no
  // obstacle is hidden.
  std::vector<Aabb> known_free_W;

  // Added all round the robot: it touches what is this close or closer. Bounds do not see it.
  double padding_m = 0;
  // Added round each moving object, solid or swept ball, per second after its t_k.
  double inflation_mps = 0;
  // Leave objects that are known to be at rest as they are; without a known motion they grow too.
  bool inflate_moving_only = false;

  std::vector<ObjectId> ignored_objects;  // those the scene does not have are fine
  // (link, object) that may touch. Object 0 is the static map with its keep-out boxes, but not
  // unknown space: for that there is known_free_W.
  std::vector<std::pair<int, ObjectId>> allowed_contacts;

  // If set, also the clearance, searched up to this distance.
  std::optional<double> clearance_up_to_m;

  bool NeedsUnknownFraction() const {
    return with_unknown_fraction || unknown == UnknownPolicy::kTolerated;
  }
};

// INVALID_ARGUMENT naming the field and the limit: lengths are at most 100 km, inflation 1 km/s,
// ids of ignored objects at least 1, links those of the robot.
absl::Status Validate(const CheckOptions& options, const Robot& robot);

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

  virtual const Robot& robot() const = 0;
  // The pinned version.
  virtual std::uint64_t version() const = 0;
  // Of the pinned version's newest frame.
  virtual Time stamp() const = 0;
};

}  // namespace clearway
