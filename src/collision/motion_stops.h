// What stops a motion.
#pragma once

#include <algorithm>
#include <cstddef>
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

  // When the world is as it is at `t` of a motion.
  Time WorldTime(Time t) const { return options.world_at.value_or(t); }
};

// From one knot to the next.
struct MotionLeg {
  TimeSpan span;
  std::vector<LinkMotion> links;
  std::vector<MovingPart> parts;  // of all links; refer to them
  // What is no longer than `longest` fits closely enough, and in what takes no longer than
  // `shortest` nothing moves by more than the resolution of contacts.
  Duration longest, shortest;
};

// What a span's sweeps touch first.
struct MotionStop {
  double share = kNever;
  double slack_m = 0;  // of the sweep that does: what it is larger than it need be
  void Add(double touched, double slack) {
    if (touched < share) *this = {touched, slack};
  }
  double until() const { return std::min(share, 1.0); }
};

// Sweeps the parts of one leg after the other through the bounds, the static map and the objects.
// Lives on one thread's stack.
class MotionStops {
 public:
  explicit MotionStops(const MotionContext& context);

  // The leg must outlive the questions about it.
  void Begin(const MotionLeg& leg);
  MotionStop First(const TimeSpan& span);

 private:
  void StopAtStatic(const MovingPart& part, const MovingPart::Passage& passage,
                    MotionStop& stop) const;
  void StopAtUnknownShare(const TimeSpan& span, MotionStop& stop);
  double MostUnknownShare(const TimeSpan& span) const;
  void StopAtObjects(const MovingPart& part, const MovingPart::Passage& passage,
                     MotionStop& stop) const;
  ObjectPiece PieceOf(const MovingObject& object, Time from, Time until) const;
  void StopAtObject(const MovingPart& part, const MovingPart::Passage& passage, std::size_t object,
                    MotionStop& stop) const;
  bool Allowed(int link, ObjectId object) const;

  const MotionContext& context_;
  const SceneSnapshot& scene_;
  const CheckOptions& options_;
  Aabb bounds_W_;
  const MotionLeg* leg_ = nullptr;
  Duration unknown_step_{};  // of the leg: in such steps the share of unknown space is bounded
};

}  // namespace clearway
