#include "scene/other_ids.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "scene/reidentification.h"

namespace clearway {
namespace {

// What is known for longer is another object, or it would have been known again.
constexpr Duration kYoung = std::chrono::seconds(2);
// So long is waited before maps are joined, unless the new one goes out of sight before: of a first
// glimpse (a flank without its ends) nobody knows where exactly it fits.
constexpr Duration kFirstGlimpse = std::chrono::milliseconds(600);
// What was not seen for so long has gone out of sight: longer than the time between two scans of a
// sensor, whatever other sensors see meanwhile.
constexpr Duration kOutOfSight = std::chrono::milliseconds(250);

// Those of parts and of what they are parts of.
std::set<ObjectId> IdsInGroups(const ObjectMap& objects) {
  std::set<ObjectId> ids;
  for (const auto& [id, object] : objects) {
    if (object->part_of != kStaticLabel) ids.insert({id, object->part_of});
  }
  return ids;
}

bool IsToBeJoined(const MovingObject& object, Time stamp) {
  if (object.given() || stamp - object.first_seen > kYoung) return false;
  const bool glimpsed = object.last_seen - object.first_seen < kFirstGlimpse;
  return glimpsed == (stamp - object.last_seen > kOutOfSight);
}

std::vector<ObjectId> IdsOf(const MovingObject& object) {
  std::vector<ObjectId> ids = object.also;
  ids.insert(ids.begin(), object.id);
  return ids;
}

// As what it is told by now alone.
MovingObject UnderNewestId(MovingObject object) {
  object.id = object.also.back();
  object.also.clear();
  object.older_ids_told = {};
  return object;
}

// Fewer points of an id than these, beside another's, are wrong labels.
constexpr std::size_t kNotStray = 5;

struct Match {
  ObjectId lost, young;
  Pose T_Y_L;  // of their frames
};

std::vector<Match> MatchesOf(const MovingObject& young, const ObjectMap& objects, Time stamp,
                             const SceneParams& params) {
  std::vector<Match> matches;
  if (!IsToBeJoined(young, stamp)) return {};
  for (const auto& [id, lost] : objects) {
    if (lost->given() || lost->t_k() >= young.first_seen) continue;
    const std::optional<Pose> T_Y_L = SeenAgain(*lost, young, params);
    if (T_Y_L) matches.push_back({id, young.id, *T_Y_L});
  }
  return matches;
}

}  // namespace

SceneObjects WithoutLapsedIds(SceneObjects objects, const ClueMap& clues, Time stamp,
                              const SceneParams& params) {
  for (auto& object : objects) {
    if (object->also.empty() || stamp - object->older_ids_told <= params.object_lifetime) continue;
    const std::vector<ObjectId> ids = IdsOf(*object);
    const bool told_anew =
        std::any_of(ids.begin(), ids.end() - 1, [&](ObjectId id) { return clues.contains(id); });
    if (told_anew) object = std::make_shared<const MovingObject>(UnderNewestId(*object));
  }
  return objects;
}

std::set<ObjectId> GatherUnderFirstIds(const SceneObjects& objects, ClueMap& clues) {
  std::set<ObjectId> two_after_all;
  for (const auto& object : objects) {
    if (object->also.empty()) continue;
    std::vector<ClueMap::iterator> told;  // that with most points last
    for (const ObjectId id : IdsOf(*object)) {
      if (const auto clue = clues.find(id); clue != clues.end()) told.push_back(clue);
    }
    std::ranges::stable_sort(told, {}, [](const auto& clue) { return clue->second.points.size(); });
    if (told.empty()) continue;
    if (told.size() > 1 && told[told.size() - 2]->second.points.size() >= kNotStray) {
      two_after_all.insert(object->id);
      continue;
    }
    ObjectClue clue = told.back()->second;
    clue.by_older_id = told.back()->first != object->also.back();
    for (const auto& other : told) clues.erase(other);
    clues[object->id] = clue;
  }
  return two_after_all;
}

std::size_t JoinSeenAgain(ObjectMap& objects, Time stamp, const SceneParams& params,
                          ThreadPool& pool) {
  const std::set<ObjectId> in_groups = IdsInGroups(objects);
  std::vector<Match> matches;
  for (const auto& [id, object] : objects) {
    if (in_groups.contains(id)) continue;
    const std::vector<Match> of_object = MatchesOf(*object, objects, stamp, params);
    matches.insert(matches.end(), of_object.begin(), of_object.end());
  }
  std::erase_if(matches, [&](const Match& match) { return in_groups.contains(match.lost); });
  std::size_t joined = 0;
  for (const Match& match : matches) {
    const auto same = std::count_if(matches.begin(), matches.end(), [&](const Match& other) {
      return other.lost == match.lost || other.young == match.young;
    });
    // In a chain of three the first two go first.
    const bool lost_is_matched =
        std::ranges::any_of(matches, [&](const Match& other) { return other.young == match.lost; });
    if (same > 1 || lost_is_matched) continue;
    const MovingObject& lost = *objects.at(match.lost);
    const MovingObject& young = *objects.at(match.young);
    objects[match.lost] =
        std::make_shared<const MovingObject>(Joined(lost, young, match.T_Y_L, stamp, params, pool));
    objects.erase(match.young);
    ++joined;
  }
  return joined;
}

}  // namespace clearway
