// One motion of a robot against one scene.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clearway/collision/motion.h"
#include "clearway/scene/object_index.h"
#include "collision/link_motion.h"
#include "collision/moving_part.h"
#include "collision/state_check.h"
#include "collision/sweep.h"

namespace clearway {

// What all motions of a batch have in common. Refers to all of it.
struct MotionContext {
  const CheckContext& check;  // for states
  const ObjectSolids& solids;
  const ObjectIndex& index;
  const MotionOptions& options;
};

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
  // From one knot to the next.
  struct Leg {
    TimeSpan span;
    std::vector<LinkMotion> links;
    std::vector<MovingPart> parts;  // of all links; refer to them
    Duration longest, shortest;     // spans; see LongestSpan and ShortestSpan
  };
  // What a span's sweeps touch first.
  struct Stop {
    double share = kNever;
    double slack_m = 0;  // of the sweep that does: what it is larger than it need be
    void Add(double touched, double slack) {
      if (touched < share) *this = {touched, slack};
    }
    double until() const { return std::min(share, 1.0); }
  };

  // From these poses of the links to those. deviations_m: null, or one for each link.
  void SetLeg(const TimeSpan& span, const Pose* from_T_W_L, const Pose* until_T_W_L,
              const double* deviations_m);
  // Whether the leg is free; else the answer is complete.
  bool Prove(MotionAnswer& answer);
  Time EarliestContact(const TimeSpan& span, double slack_m, Time end, MotionAnswer& answer);
  // What is no longer than that fits closely enough, and in what takes no longer nothing moves by
  // more than the resolution of contacts.
  Duration LongestSpan() const;
  Duration ShortestSpan() const;
  Stop FirstStop(const TimeSpan& span);
  void StopAtStatic(const MovingPart& part, const MovingPart::Passage& passage, Stop& stop) const;
  void StopAtUnknownShare(const TimeSpan& span, Stop& stop);
  double MostUnknownShare(const TimeSpan& span) const;
  void StopAtObjects(const MovingPart& part, const MovingPart::Passage& passage, Stop& stop) const;
  ObjectPiece PieceOf(const MovingObject& object, Time from, Time until) const;
  void StopAtObject(const MovingPart& part, const MovingPart::Passage& passage, std::size_t object,
                    Stop& stop) const;
  // When the world is as it is at `t`.
  Time WorldTime(Time t) const { return context_.options.world_at.value_or(t); }
  bool Allowed(int link, ObjectId object) const;
  bool Ignored(ObjectId object) const;

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
  Aabb bounds_W_;
  double fastest_object_mps_ = 0;  // of any of its points
  Leg leg_;                        // at hand
  Duration unknown_step_{};  // of the leg: in such steps the share of unknown space is bounded
  std::vector<Pose> T_W_L_;  // of StateAt
};

}  // namespace clearway
