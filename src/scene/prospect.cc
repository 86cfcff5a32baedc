#include "scene/prospect.h"

#include "scene/object_motion.h"
#include "scene/position_bound.h"

namespace clearway {

Prospect ProspectOf(std::span<const StampedPose> track, Time since, const Twist& last_motion_O,
                    const Solid& solid, const SceneParams& params) {
  const auto by_rule = [&](std::span<const StampedPose> past) {
    return GoesOnByItself(past, solid, params);
  };
  const Twist velocity_O = GoesOn(track, last_motion_O, solid, params);
  const bool has_motion = track.size() > 1;
  const PastMisses misses = MissesOf(track, since, solid, by_rule);
  if (has_motion && params.motion == MotionModel::kTrack && !(velocity_O == Twist{})) {
    const PastMisses misses_of_last = MissesOf(track, since, solid, LastMotionOf);
    if (IsClearlyBetter(misses_of_last, misses)) {
      return {last_motion_O,
              BoundBy(misses_of_last, has_motion, last_motion_O, params.MendsObjectPoses())};
    }
  }
  const bool of_two = params.motion == MotionModel::kLastMotion;
  return {velocity_O, BoundBy(misses, has_motion, velocity_O, of_two && params.MendsObjectPoses())};
}

}  // namespace clearway
