#include "scene/object_groups.h"

#include <algorithm>
#include <string>

#include "absl/strings/str_cat.h"
#include "scene/group_motion.h"

namespace clearway {
namespace {

// The one that an object goes by, if the scene has it.
ObjectId FirstIdOf(ObjectId id, const ObjectMap& objects) {
  if (objects.contains(id)) return id;
  const auto named = std::ranges::find_if(
      objects, [&](const auto& object) { return object.second->IsCalled(id); });
  return named == objects.end() ? id : named->first;
}

ObjectMap ById(const SceneObjects& objects) {
  ObjectMap by_id;
  for (const auto& object : objects) by_id[object->id] = object;
  return by_id;
}

// The object of the group after whose motion the others can go, null if there is none.
const MovingObject* LeaderOf(const ObjectGroup& group, const ObjectMap& objects,
                             const ClueMap& clues, Time stamp) {
  for (const ObjectId id : group) {
    const auto clue = clues.find(id);
    const MovingObject& object = *objects.at(id);
    const bool placed = clue != clues.end() && clue->second.Places() && object.t_k() == stamp;
    if (placed && object.velocity_O) return &object;
  }
  return nullptr;
}

}  // namespace

absl::Status CheckParts(const Frame& frame, const SceneObjects& objects) {
  if (frame.parts.empty()) return absl::OkStatus();
  const ObjectMap by_id = ById(objects);
  std::map<ObjectId, ObjectId> wholes;
  for (const auto& [id, object] : by_id) wholes[id] = object->part_of;
  for (const auto& [id, whole] : frame.parts) {
    wholes[FirstIdOf(id, by_id)] = FirstIdOf(whole, by_id);
  }
  for (std::size_t i = 0; i < frame.parts.size(); ++i) {
    const ObjectId id = FirstIdOf(frame.parts[i].id, by_id), whole = wholes[id];
    if (whole == kStaticLabel) continue;
    const std::string field = absl::StrCat("parts[", i, "]");
    if (whole == id) {
      return absl::FailedPreconditionError(
          absl::StrCat(field, ".whole_id: is another id of object ", id, " itself"));
    }
    if (const auto of_whole = wholes.find(whole);
        of_whole != wholes.end() && of_whole->second != kStaticLabel) {
      return absl::FailedPreconditionError(absl::StrCat(
          field, ".whole_id: object ", whole, " is itself a part, of object ", of_whole->second));
    }
    const auto has_parts =
        std::ranges::find_if(wholes, [&](const auto& other) { return other.second == id; });
    if (has_parts == wholes.end()) continue;
    return absl::FailedPreconditionError(absl::StrCat(
        field, ".object_id: object ", id, " has a part itself, object ", has_parts->first));
  }
  return absl::OkStatus();
}

void SetParts(const std::vector<ObjectPart>& parts, ObjectMap& objects) {
  for (const ObjectPart& part : parts) {
    const auto place = objects.find(FirstIdOf(part.id, objects));
    const ObjectId whole = FirstIdOf(part.whole, objects);
    if (place == objects.end() || place->second->part_of == whole) continue;
    MovingObject object = *place->second;
    object.part_of = whole;
    if (whole != kStaticLabel && object.completion && object.completion->unseen_end != 0) {
      object.completion->unseen_end = 0;
      VoxelMap map_O = object.map_O;
      object = WithMap(std::move(object), std::move(map_O));
    }
    place->second = std::make_shared<const MovingObject>(std::move(object));
  }
}

std::vector<ObjectGroup> GroupsOf(const SceneObjects& objects) { return GroupsOf(ById(objects)); }

std::vector<ObjectGroup> GroupsOf(const ObjectMap& objects) {
  std::map<ObjectId, ObjectGroup> by_whole;
  for (const auto& [id, object] : objects) {
    if (object->part_of == kStaticLabel) continue;
    ObjectGroup& group = by_whole[object->part_of];
    if (group.empty() && objects.contains(object->part_of)) group.push_back(object->part_of);
    group.push_back(id);
  }
  std::vector<ObjectGroup> groups;
  for (auto& [whole, group] : by_whole) {
    if (group.size() > 1) groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<ObjectMotion> MotionsAlong(const ObjectMap& before, const ObjectMap& now,
                                       const ClueMap& clues, Time stamp) {
  std::vector<ObjectMotion> motions;
  for (const ObjectGroup& group : GroupsOf(before)) {
    const MovingObject* leader = LeaderOf(group, now, clues, stamp);
    if (leader == nullptr) continue;
    const Pose& T_W_now = leader->history.back().T_W_O;
    for (const ObjectId id : group) {
      const MovingObject& part = *now.at(id);
      const auto clue = clues.find(id);
      if (part.t_k() >= stamp || (clue != clues.end() && clue->second.Places())) continue;
      // A short history may not reach back so far, that of the object before does.
      const bool remembers = leader->history.front().stamp <= part.t_k();
      const MovingObject& then = remembers ? *leader : *before.at(leader->id);
      const Pose T_W_then = PredictPose(then, part.t_k(), Duration::max()).T_W_O;
      motions.push_back({id, T_W_now * Inverse(T_W_then), part.t_k()});
    }
  }
  return motions;
}

void GoAlong(const ClueMap& clues, Time stamp, const SceneParams& params, ObjectMap& objects) {
  for (const ObjectGroup& group : GroupsOf(objects)) {
    const MovingObject* leader = LeaderOf(group, objects, clues, stamp);
    if (leader == nullptr) continue;
    for (const ObjectId id : group) {
      std::shared_ptr<const MovingObject>& part = objects.at(id);
      if (id == leader->id || part->t_k() != stamp) continue;
      part = std::make_shared<const MovingObject>(GoingAlong(*part, *leader, params));
    }
  }
}

}  // namespace clearway
