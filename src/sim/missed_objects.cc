#include "clearway/sim/missed_objects.h"

#include <algorithm>
#include <map>

namespace clearway {

Frame WithoutObjects(Frame frame, const std::set<ObjectId>& missed) {
  const auto is_missed = [&](ObjectId id) { return missed.contains(id); };
  std::ranges::replace_if(frame.labels, is_missed, kStaticLabel);
  std::erase_if(frame.motions, [&](const ObjectMotion& motion) { return is_missed(motion.id); });
  std::erase_if(frame.poses, [&](const ObjectPose& pose) { return is_missed(pose.id); });
  std::erase_if(frame.parts, [&](const ObjectPart& part) {
    return is_missed(part.id) || is_missed(part.whole);
  });
  return frame;
}

Frame WithoutParts(Frame frame) {
  std::map<ObjectId, ObjectId> wholes;
  for (const ObjectPart& part : frame.parts) {
    if (part.whole != kStaticLabel) wholes[part.id] = part.whole;
  }
  for (ObjectId& label : frame.labels) {
    if (const auto part = wholes.find(label); part != wholes.end()) label = part->second;
  }
  std::erase_if(frame.motions, [&](const auto& motion) { return wholes.contains(motion.id); });
  std::erase_if(frame.poses, [&](const auto& pose) { return wholes.contains(pose.id); });
  frame.parts.clear();
  return frame;
}

}  // namespace clearway
