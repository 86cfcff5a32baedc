// One motion of a robot against one scene.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "clearway/collision/motion.h"
#include "collision/motion_stops.h"
#include "collision/state_check.h"

namespace clearway {

// Proves motions free, or finds their first contact, from the first knot on by spans of time: what
// no part's sweep touches is free; else the span is cut where something may be touched, and what
// follows is tried again by shorter spans, whose sweeps fit closer. Lives on one thread's stack.
class MotionCheck {
 public:
  MotionCheck(const MotionContext& context, const RobotGeometry& robot);

  // deviations_m: null, or one for each pose.
  void Answer(std::span<const Time> times, const Pose* T_W_L, const double* deviations_m,
              MotionAnswer& answer);

 private:
  // From these poses of the links to those. deviations_m: null, or one for each link.
  void SetLeg(const TimeSpan& span, const Pose* from_T_W_L, const Pose* until_T_W_L,
              const double* deviations_m);
  // Whether the leg is free; else the answer is complete.
  bool Prove(MotionAnswer& answer);
  Time EarliestContact(const TimeSpan& span, double slack_m, Time end, MotionAnswer& answer);
  // See MotionLeg.
  Duration LongestSpan() const;
  Duration ShortestSpan() const;

  StateAnswer StateAt(Time t);
  // Whether the state at `t` is not free; then the answer gets its status and its contact.
  bool InContact(Time t, MotionAnswer& answer);
  // Of what the state last asked about touches.
  std::optional<VoxelKey> TouchedVoxel(Time t, const StateAnswer& state) const;

  const MotionContext& context_;
  const SceneSnapshot& scene_;
  const CheckOptions& options_;
  const RobotGeometry& robot_;
  StateCheck states_;
  MotionStops stops_;
  MotionLeg leg_;            // at hand
  std::vector<Pose> T_W_L_;  // of StateAt
};

}  // namespace clearway
