// What the report of a frame says of single objects.
#pragma once

#include <cstddef>

#include "clearway/scene/frame.h"

namespace clearway {

enum class ObjectIssueKind {
  // Its motion or pose was left out, as if the frame did not have it:
  kTurnTooLarge = 1,    // turns by `value` rad, or from where it was predicted, more than `limit`
  kMotionTooFar = 2,    // leads to a coordinate of `value` m, beyond FrameLimits::max_coordinate_m
  kMotionConflict = 3,  // another motion or pose of the object under another of its ids counts
  kMotionTooFast = 6,   // moves it at `value` m/s, more than kMaxSpeed_mps
  kContradicted = 7,    // puts it (or the given object lies) `value` m from its points
  kJumped = 8,          // puts it `value` m from where it was predicted, more than `limit` m
  kStartsTooEarly = 9,  // starts `value` s before it was first seen, more than `limit` s
  // It was dropped, and a new model with the same id begins: its points came without a motion or
  // pose, or their motions are contradicted, and
  kRestarted = 4,       // they are `value` m off, more than `limit` m (the 95 % bound)
  kBridgedTooLong = 5,  // its last known pose is `value` s old; the horizon is `limit` s
};

// A plain value.
struct ObjectIssue {
  ObjectIssueKind kind = ObjectIssueKind::kTurnTooLarge;
  ObjectId id = 0;  // as the frame names it
  double value = 0, limit = 0;
  bool operator==(const ObjectIssue&) const = default;
};

// A report lists so many; its counters count all.
inline constexpr std::size_t kMaxObjectIssues = 64;

}  // namespace clearway
