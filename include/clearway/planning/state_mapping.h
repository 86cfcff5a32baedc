// How an OMPL state becomes a time and link poses.
#pragma once

#include <ompl/base/StateSpace.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/collision/robot.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// Where a ground robot stands. Its lowest point (of its shapes' boxes, when upright) is kept
// `clearance_m` above the ground at its (x, y), so that the ground's own voxels do not block it.
// Ground fills the voxel that it lies in, up to a voxel above it, and touching is contact: on even
// ground take DefaultGroundClearance of the map's resolution and of CheckOptions::padding_m, which
// grows the robot downwards too.
struct Ground {
  // z of the ground at (x, y), metres in W; none: 0 everywhere. Must be callable from any thread,
  // and finite.
  std::function<double(double x_m, double y_m)> height_m;
  double clearance_m = 0.15;  // the same for voxels of 0.1 m without padding
  // The most that height_m changes per metre. Has to be stated with it: proofs of motions rest on
  // it.
  std::optional<double> max_slope = std::nullopt;
};

// For spaces without a time component: every state is checked at this time.
struct FixedTime {
  Time time;
};
// For SpaceTimeStateSpace: a state's time is `epoch` plus the seconds that it holds.
struct TimeSince {
  Time epoch;
};
using TimeSource = std::variant<FixedTime, TimeSince>;

// The map from states of one space to (Time, T_W_L of every link). A value, copied cheaply; any
// thread may call any method.
class StateMapping {
 public:
  // Writes T_W_L of every link for a state of the space (without its time component).
  using Kinematics = std::function<void(const ompl::base::State* state, std::span<Pose> T_W_L)>;
  // An upper bound, in metres, of the path of any point of any link while OMPL interpolates between
  // two states of the space.
  using MotionBound =
      std::function<double(const ompl::base::State* from, const ompl::base::State* to)>;
  // Writes for each link an upper bound, in metres, of how far its points stray meanwhile from
  // where they are if the link goes straight and turns evenly.
  using DeviationBound = std::function<void(
      const ompl::base::State* from, const ompl::base::State* to, std::span<double> deviations_m)>;

  // Rigid robots: every link takes the pose of the state. SE(2) states are (x, y) in metres and yaw
  // in radians about W's z; in R^2 the robot keeps `yaw_rad`. The link frame's height follows from
  // `ground` and the robot's shapes. The robot must pass Validate.
  static StateMapping Se2(const Robot& robot, Ground ground, TimeSource time);
  static StateMapping R2(const Robot& robot, Ground ground, TimeSource time, double yaw_rad = 0);
  // SE(3) and R^3 (W's axes kept) states are T_W_L itself.
  static StateMapping Se3(const Robot& robot, TimeSource time);
  static StateMapping R3(const Robot& robot, TimeSource time);

  // Any other space; for an arm's R^n see arm.h. Without a bound, edges are cut as
  // StateSpace::validSegmentCount says (setLongestValidSegmentFraction), not by metres, and links
  // are taken to go straight from cut to cut: what is proved then is no more than that. With a
  // bound, `deviations` is worth while: else they follow from the bound, and are large. All
  // functions must be callable from any thread.
  static StateMapping FromKinematics(const Robot& robot, Kinematics kinematics, TimeSource time,
                                     MotionBound bound = nullptr,
                                     DeviationBound deviations = nullptr);

  // INVALID_ARGUMENT if states of `space` are not those that the mapping reads, `robot` has another
  // number of links, or the ground has heights but no slope.
  absl::Status ValidateSpace(const ompl::base::StateSpace& space, const Robot& robot) const;

  bool has_time() const { return std::holds_alternative<TimeSince>(time_); }
  // INVALID_ARGUMENT if the state's time is not finite or does not fit into Time.
  absl::StatusOr<Time> TimeOf(const ompl::base::State* state) const;
  // Appends one state to the batch. INVALID_ARGUMENT if its time or a link's pose is not finite;
  // the batch is then as before.
  absl::Status Append(const ompl::base::State* state, StateBatch& batch) const;
  // The MotionBound for two states of the whole space; none if there is no bound.
  std::optional<double> MotionBoundMetres(const ompl::base::State* from,
                                          const ompl::base::State* to) const;
  // Into how many legs to cut the way between two states of `space`, the mapping's, so that links
  // go straight and turn evenly on each, up to their deviations: legs of leg_m where they go on
  // curves.
  double LegCount(const ompl::base::StateSpace& space, const ompl::base::State* from,
                  const ompl::base::State* to, double leg_m) const;
  // How far the links may stray from that between two states, in metres: appends one for each link.
  // T_W_L: of the links at `from`, then at `to`.
  void AppendDeviations(const ompl::base::State* from, const ompl::base::State* to,
                        std::span<const Pose> T_W_L, std::vector<double>& deviations_m) const;

 private:
  enum class Kind { kSe2, kSe3, kR2, kR3, kOther };
  StateMapping(Kind kind, std::size_t links, Kinematics kinematics, MotionBound bound,
               TimeSource time);

  Kind kind_;
  std::size_t links_;
  std::shared_ptr<const Kinematics> kinematics_;
  std::shared_ptr<const MotionBound> bound_;  // null if there is none
  DeviationBound deviations_;                 // likewise
  TimeSource time_;
  std::optional<double> slope_ = 0;  // of the ground; none if it had to be stated
  std::vector<double> reaches_m_;    // of the links of another space: from the origin
};

}  // namespace clearway
