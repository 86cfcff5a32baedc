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

// With those of some lost objects that were lost before `young` was first seen.
std::vector<Match> MatchesOf(const MovingObject& young, const ObjectMap& lost_ones,
                             const SceneParams& params) {
  std::vector<Match> matches;
  if (young.given()) return matches;
  for (const auto& [id, lost] : lost_ones) {
    if (lost->given() || lost->t_k() >= young.first_seen) continue;
    const std::optional<Pose> T_Y_L = SeenAgain(*lost, young, params);
    if (T_Y_L) matches.push_back({id, young.id, *T_Y_L});
  }
  return matches;
}

// Those of the objects that are to be joined now, and of all others that could be one of the same
// lost objects, however long they are known: what one of them may be no other one is.
struct Matches {
  std::vector<Match> due, others;

  template <class Predicate>
  std::ptrdiff_t CountIf(Predicate&& predicate) const {
    return std::ranges::count_if(due, predicate) + std::ranges::count_if(others, predicate);
  }
};

Matches FindMatches(const ObjectMap& objects, Time stamp, const SceneParams& params) {
  const std::set<ObjectId> in_groups = IdsInGroups(objects);
  ObjectMap alone;
  for (const auto& entry : objects) {
    if (!in_groups.contains(entry.first)) alone.insert(entry);
  }
  Matches matches;
  const auto add = [&](bool due, const ObjectMap& lost_ones, std::vector<Match>& to) {
    for (const auto& [id, object] : alone) {
      if (IsToBeJoined(*object, stamp) != due) continue;
      const std::vector<Match> of_object = MatchesOf(*object, lost_ones, params);
      to.insert(to.end(), of_object.begin(), of_object.end());
    }
  };
  add(true, alone, matches.due);
  ObjectMap wanted;
  for (const Match& match : matches.due) wanted[match.lost] = alone.at(match.lost);
  add(false, wanted, matches.others);
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
  const Matches matches = FindMatches(objects, stamp, params);
  std::size_t joined = 0;
  for (const Match& match : matches.due) {
    const bool unique = matches.CountIf([&](const Match& other) {
      return other.lost == match.lost || other.young == match.young;
    }) == 1;
    // In a chain of three the first two go first.
    const bool lost_is_matched =
        matches.CountIf([&](const Match& other) { return other.young == match.lost; }) > 0;
    if (!unique || lost_is_matched) continue;
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
