// Whole motions of a robot: what they are, and what a check says of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/collision/check_options.h"
#include "clearway/collision/robot.h"
#include "clearway/geometry/pose.h"
#include "clearway/map/voxel_key.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// A batch of motions. Each is a row of knots in ascending time, at least two; from one to the next
// every link's origin goes straight and its rotation turns the shorter way about one axis, both at
// constant speed. A value.
struct MotionBatch {
  std::vector<std::size_t> knot_counts;  // of each motion
  std::vector<Time> times;               // of the knots, motion by motion
  std::vector<Pose> T_W_L;               // link l at knot k is at k * (number of links) + l
  // How far a point of the link may stray from the motion above, in metres, on the way from the
  // knot to the next; parallel to T_W_L (those of a motion's last knot do not matter). Empty: not
  // at all. A robot whose joints move the links along other curves states here by how much.
  std::vector<double> deviations_m;
};

// What a check of motions takes into account. A plain value.
struct MotionOptions {
  CheckOptions check;  // without a clearance and without the share of unknown space
  // Where neither freedom nor contact can be proved, bisection ends at motions of this length.
  double contact_resolution_m = 0.01;
  // If set, the world stands still as it is at this time while the robot moves: for plans without
  // time. The times of knots then only say how fast the robot goes.
  std::optional<Time> world_at = std::nullopt;
};

// The first contact of a motion. A plain value.
struct MotionWitness {
  Time from, until;  // free before `from`; in contact at `until`
  int link = -1;     // as in StateAnswer, at `until`
  ObjectId object = kStaticLabel;
  // A voxel in contact at `until`, of the static map or of the object's own; none if it is not a
  // voxel that is touched.
  std::optional<VoxelKey> voxel;
};

struct MotionAnswer {
  // kFree is proved for every moment of the motion, from its first knot to its last. kUnresolved is
  // neither proved free nor in contact, within bounded effort: what is passed within about a
  // sixtieth of contact_resolution_m (a tenth beside an object that turns by 9 rad between knots),
  // or touches only the hull of an open mesh. What a robot comes no nearer to, as when turning on a
  // surface, is proved free wherever its states are, up to 0.2 micrometres: a robot nearer than 0.2
  // micrometres is in contact, and one nearer than 0.4 may be unresolved unless it rests. Anything
  // else is the status at the witness' end.
  SpaceStatus status = SpaceStatus::kUnresolved;
  // Proved free from the first knot up to here.
  Time free_until;
  std::optional<MotionWitness> witness;  // unless free or unresolved
};

// A proof holds for this version, with predictions within the horizon, and with the options'
// inflation and multiple of the objects' bounds.
struct MotionReply {
  std::uint64_t version = 0;
  Time stamp;
  Duration horizon{};
  double inflation_mps = 0, bound_multiple = 0;
  std::vector<MotionAnswer> answers;  // one per motion, in their order
};

// INVALID_ARGUMENT naming the field: arrays that do not fit each other or the robot, a motion of
// fewer than two knots, times that do not ascend, what Validate says of the states and options, a
// deviation or a resolution that is not finite or negative, a clearance or share asked for.
absl::Status Validate(const MotionBatch& motions, const Robot& robot);
absl::Status Validate(const MotionOptions& options, const Robot& robot);

}  // namespace clearway
