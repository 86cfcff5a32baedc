// Planning problems and their solutions as plain data: what goes over a wire and into a file.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// The robot stands upright on level ground and moves as one body. A configuration is x and y of its
// links' common frame in metres in W, and, if it turns, its yaw in radians about W's z. The lowest
// point of its shapes' boxes is kept clearance_m above the ground, without it
// DefaultGroundClearance.
struct PlaneSpace {
  bool turns = true;
  double yaw_rad = 0;  // if it does not turn
  double ground_z_m = 0;
  std::optional<double> clearance_m = std::nullopt;
};

// At what clearance even ground is free under a robot, in a static map of these voxels: ground
// fills the voxel that it lies in, the top of which is up to a voxel above it. Half a voxel more
// is for points that stray into the next one. Obstacles lower than that may not be seen.
double DefaultGroundClearance(double resolution_m, double padding_m);

// It flies as one body: x, y, z in W, and, if it turns, the unit quaternion x, y, z, w of its
// rotation; else it keeps W's axes.
struct FlightSpace {
  bool turns = true;
};

// A revolute joint. Angles in radians. It is locked if min_rad is max_rad; then max_radps may be 0.
struct Joint {
  Pose T_P_J;  // of the joint's frame J at angle 0 in the frame P of the link before it
  Eigen::Vector3d axis_J = Eigen::Vector3d::UnitZ();  // that the next link turns about; any length
  double min_rad = 0, max_rad = 0;
  double max_radps = 0;
};

// An arm: the robot's first link stands still at T_W_B, each other turns about the joint before it;
// its frame is the joint's. A configuration is the joints' angles.
struct ArmSpace {
  Pose T_W_B;
  std::vector<Joint> joints;  // one fewer than the robot has links
};

using ConfigurationSpace = std::variant<PlaneSpace, FlightSpace, ArmSpace>;

// How many numbers a configuration has.
std::size_t DimensionOf(const ConfigurationSpace& space);

// With a quaternion of length 1, if it has one. For a configuration of a valid task.
std::vector<double> NormalizedConfiguration(const ConfigurationSpace& space,
                                            std::vector<double> values);

inline constexpr double kMaxTimeLimit_s = 3600;

// From one configuration to another, as early as can be. A plain value.
struct PlanTask {
  ConfigurationSpace space;
  // Where x, y (and z) of configurations may be, along an axis at one place alone if the area has
  // no extent there; not of arms.
  Aabb area_W;
  double max_speed_mps = 0;   // along x, y (and z) together; not of arms
  double max_turn_radps = 0;  // if it turns
  std::vector<double> start, goal;
  Time start_time;
  Duration time_limit{};  // from there to the arrival
  MotionOptions options;  // without world_at
};

// INVALID_ARGUMENT naming the field and the limit: numbers that are not finite, limits that are not
// positive, more than 32 joints, a time limit above an hour, configurations of another size, out of
// the area or of the joints' limits, what Validate says of the options.
absl::Status Validate(const PlanTask& task, const Robot& robot);

// Whether configurations of the space turn the robot as a whole, so that max_turn_radps is needed.
bool Turns(const ConfigurationSpace& space);

// A way from start to goal. From one configuration to the next the robot goes straight in its
// space, at constant speed; between two equal ones it waits. A plain value.
struct Plan {
  std::vector<Time> times;
  std::vector<std::vector<double>> configurations;  // as many
  // The same as one motion of the robot's links, which any StateChecker can prove again, of this
  // scene version or of a newer one. None if the goal is where the start is.
  MotionBatch motion;
};

enum class PlanStatus {
  kFound,
  kNotFound,      // within the time that there was to think
  kStartBlocked,  // at the start time
  // Whenever it was looked at, from when on it could be reached, every 20 ms: a shorter gap may be
  // missed.
  kGoalBlocked,
  // The straight way is not free, and no place was found by way of which there is more time than
  // the limit leaves.
  kNoTimeToSpare,
};

// How a search ended. Its plans are proved free on this version, with predictions within the
// horizon, and with the options' inflation and multiple of bounds. A plain value.
struct PlanOutcome {
  std::uint64_t version = 0;
  Time stamp;
  Duration horizon{};  // zero if nothing was proved
  double inflation_mps = 0, bound_multiple = 0;
  PlanStatus status = PlanStatus::kNotFound;
  StateAnswer blocker;  // what is in the way, if the start or the goal is blocked
};

}  // namespace clearway
