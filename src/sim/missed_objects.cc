#include "clearway/sim/missed_objects.h"

#include <algorithm>

namespace clearway {

Frame WithoutObjects(Frame frame, const std::set<ObjectId>& missed) {
  const auto is_missed = [&](ObjectId id) { return missed.contains(id); };
  std::ranges::replace_if(frame.labels, is_missed, kStaticLabel);
  std::erase_if(frame.motions, [&](const ObjectMotion& motion) { return is_missed(motion.id); });
  std::erase_if(frame.poses, [&](const ObjectPose& pose) { return is_missed(pose.id); });
  return frame;
}

}  // namespace clearway
