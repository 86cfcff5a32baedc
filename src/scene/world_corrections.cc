#include "clearway/scene/world_corrections.h"

#include <algorithm>

namespace clearway {

void WorldCorrections::Add(Time stamp, const Pose& T_W_V) {
  if (!poses_.empty() && poses_.back().stamp == stamp) poses_.pop_back();
  poses_.push_back({stamp, T_W_V});
  // The last one before that time, too: it held then.
  const auto after = std::find_if(poses_.begin(), poses_.end() - 1,
                                  [&](const Stamped& p) { return stamp - p.stamp < kept_; });
  if (after != poses_.begin()) poses_.erase(poses_.begin(), after - 1);
}

Pose WorldCorrections::At(Time t) const {
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), t,
                                      [](const Stamped& p, Time time) { return p.stamp < time; });
  if (after == poses_.end()) return poses_.empty() ? Pose{} : poses_.back().T_W_V;
  if (after->stamp == t || after == poses_.begin()) return after->T_W_V;
  const Stamped& before = *(after - 1);
  return Interpolate(before.T_W_V, after->T_W_V,
                     ToSeconds(t - before.stamp) / ToSeconds(after->stamp - before.stamp));
}

Pose Carried(const WorldCorrections& corrections, Time t, const Pose& T_V_X) {
  const Pose T_W_V = corrections.At(t);
  return T_W_V == Pose{} ? T_V_X : T_W_V * T_V_X;
}

Frame CarriedBy(const WorldCorrections& corrections, Frame frame) {
  const Time stamp = frame.stamp;
  frame.T_W_S = Carried(corrections, stamp, frame.T_W_S);
  for (ObjectPose& pose : frame.poses) pose.T_W_B = Carried(corrections, stamp, pose.T_W_B);
  for (ObjectMotion& motion : frame.motions) {
    const Pose before = corrections.At(motion.from), now = corrections.At(stamp);
    if (before == Pose{} && now == Pose{}) continue;
    motion.H_W = now * motion.H_W * Inverse(before);
  }
  return frame;
}

}  // namespace clearway
