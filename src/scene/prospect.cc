#include "scene/prospect.h"

#include <utility>

#include "scene/object_motion.h"
#include "scene/position_bound.h"

namespace clearway {

Evidence EvidenceOf(std::span<const StampedPose> track, Time since, const Twist& last_motion_O,
                    const Solid& solid, const SceneParams& params) {
  const auto by_rule = [&](std::span<const StampedPose> past) {
    return GoesOnByItself(past, solid, params);
  };
  const bool by_track = params.motion == MotionModel::kTrack;
  Evidence evidence{GoesOn(track, last_motion_O, solid, params),
                    MissesOf(track, since, solid, by_rule), track.size() > 1, !by_track};
  if (!by_track || !evidence.has_motion || evidence.velocity_O == Twist{}) return evidence;
  PastMisses misses_of_last = MissesOf(track, since, solid, LastMotionOf);
  if (!IsClearlyBetter(misses_of_last, evidence.misses)) return evidence;
  return {last_motion_O, std::move(misses_of_last), true, true};
}

Prospect ProspectOf(std::span<const StampedPose> track, Time since, const Twist& last_motion_O,
                    const Solid& solid, const SceneParams& params) {
  const Evidence evidence = EvidenceOf(track, since, last_motion_O, solid, params);
  return {evidence.velocity_O, BoundBy(evidence.misses, evidence.has_motion, evidence.velocity_O,
                                       evidence.of_last_motion)};
}

}  // namespace clearway
