// What checks of states and motions take into account, beside the scene.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "clearway/collision/robot.h"
#include "clearway/geometry/aabb.h"
#include "clearway/scene/moving_object.h"

namespace clearway {

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
  // Added likewise: so many times the distance from where an object is predicted that its centre
  // keeps in 95 of 100 cases (PositionBound).
  double bound_multiple = 0;
  // Leave objects that are known to be at rest as they are; without a known motion they grow too.
  bool inflate_moving_only = false;

  std::vector<ObjectId> ignored_objects;  // those the scene does not have are fine
  // (link, object) that may touch. Object 0 is the static map with its keep-out boxes, but not
  // unknown space: for that there is known_free_W.
  std::vector<std::pair<int, ObjectId>> allowed_contacts;

  // If set, also the clearance, searched up to this distance.
  std::optional<double> clearance_up_to_m;

  ObjectGrowth growth() const { return {inflation_mps, bound_multiple}; }
  bool NeedsUnknownFraction() const {
    return with_unknown_fraction || unknown == UnknownPolicy::kTolerated;
  }
};

// INVALID_ARGUMENT naming the field and the limit: lengths are at most 100 km, inflation 1 km/s,
// bounds are taken 100 times at most, ids of ignored objects are at least 1, links those of the
// robot.
absl::Status Validate(const CheckOptions& options, const Robot& robot);

}  // namespace clearway
