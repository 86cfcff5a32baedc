#include "clearway/sim/forgetful_tracker.h"

#include <utility>
#include <vector>

namespace clearway {

ObjectId ForgetfulTracker::See(ObjectId id, Frame& told) {
  const auto [entry, is_new] = tracks_.try_emplace(id, Track{id, told.stamp, std::nullopt});
  Track& track = entry->second;
  const bool lost = told.stamp - track.last_seen > memory_;
  if (lost) track.told = next_++;
  if (!is_new && !lost && track.H_W && track.last_seen < told.stamp) {
    told.motions.push_back({track.told, *track.H_W, track.last_seen});
  }
  track.H_W.reset();
  track.last_seen = told.stamp;
  true_ids_[track.told] = id;
  return track.told;
}

Frame ForgetfulTracker::Retold(Frame frame) {
  for (const ObjectMotion& motion : std::exchange(frame.motions, {})) {
    const auto track = tracks_.find(motion.id);
    if (track == tracks_.end()) continue;
    std::optional<Pose>& H_W = track->second.H_W;
    H_W = motion.H_W * H_W.value_or(Pose());
  }
  std::map<ObjectId, ObjectId> told;
  for (ObjectId& label : frame.labels) {
    if (label <= kStaticLabel) continue;
    const auto [entry, is_new] = told.try_emplace(label);
    if (is_new) entry->second = See(label, frame);
    label = entry->second;
  }
  std::erase_if(frame.poses, [&](const ObjectPose& p) { return !told.contains(p.id); });
  for (ObjectPose& pose : frame.poses) pose.id = told.at(pose.id);
  // Of what it does not see it says nothing; a whole keeps its newest id.
  std::erase_if(frame.parts, [&](const ObjectPart& part) { return !told.contains(part.id); });
  for (ObjectPart& part : frame.parts) {
    part.id = told.at(part.id);
    const auto whole = tracks_.find(part.whole);
    if (whole != tracks_.end()) part.whole = whole->second.told;
  }
  return frame;
}

}  // namespace clearway
