#include "scene/other_ids.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "scene/mutual_fit.h"
#include "scene/other_shape.h"
#include "scene/reidentification.h"
#include "scene/same_object.h"
#include "scene/sparse_sight.h"

namespace clearway {
namespace {

// So long is waited before maps are joined, unless the new one goes out of sight before: of a first
// glimpse (a flank without its ends) nobody knows where exactly it fits.
constexpr Duration kFirstGlimpse = std::chrono::milliseconds(600);

// Those of parts and of what they are parts of.
std::set<ObjectId> IdsInGroups(const ObjectMap& objects) {
  std::set<ObjectId> ids;
  for (const auto& [id, object] : objects) {
    if (object->part_of != kStaticLabel) ids.insert({id, object->part_of});
  }
  return ids;
}

bool IsToBeJoined(const MovingObject& object, Time stamp) {
  if (object.given() || !IsYoung(object, stamp)) return false;
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

// Of the objects that are to be joined now.
std::vector<Match> FindMatches(const ObjectMap& objects, Time stamp, const SceneParams& params) {
  const std::set<ObjectId> in_groups = IdsInGroups(objects);
  std::vector<Match> matches;
  for (const auto& [young_id, young] : objects) {
    if (in_groups.contains(young_id) || !IsToBeJoined(*young, stamp)) continue;
    for (const auto& [lost_id, lost] : objects) {
      if (in_groups.contains(lost_id) || !WasLostBefore(*lost, *young)) continue;
      const std::optional<Pose> T_Y_L = SeenAgain(*lost, *young, params);
      if (T_Y_L) matches.push_back({lost_id, young_id, *T_Y_L});
    }
  }
  return matches;
}

// Whether the other was seen while the lost one was out of sight before, between two sights of it
// that were joined since, and where that one must have been then: no two are in one place.
bool IsSightBetween(const MovingObject& other, const MovingObject& lost) {
  const auto after = std::ranges::find_if(
      lost.history, [&](const StampedPose& pose) { return pose.stamp >= other.first_seen; });
  if (after == lost.history.begin() || after == lost.history.end()) return false;
  if (after->stamp <= other.t_k()) return false;
  const Eigen::Vector3d center_W = other.history.back().T_W_O * other.observed_box_O.Center();
  const Pose T_W_L = PredictPose(lost, other.t_k(), Duration::max()).T_W_O;
  return lost.observed_box_O.Contains(Inverse(T_W_L) * center_W);
}

// Whether an object that may be the young one as well is likely to be the lost one, too: where it
// was to be then, another one cannot have been; or, as the young one, it is much farther off.
bool IsLostOne(const Match& match, double as_young_m, double as_lost_m, const ObjectMap& objects,
               const SceneParams& params) {
  constexpr double kNearlyAsWell = 2;
  const MovingObject& lost = *objects.at(match.lost);
  const double beside_m = ToleranceOfPlace_m(lost, 0, 0);
  const double match_m = DistanceIfSame_m(lost, *objects.at(match.young), params).value_or(0);
  return as_lost_m <= beside_m || as_young_m > kNearlyAsWell * match_m + beside_m;
}

// Whether the young one may be another object that was lost, or the lost one another that was seen
// since: however long that one is known by now.
bool IsRival(const Match& match, const MovingObject& other, const ObjectMap& objects, Time stamp,
             const SceneParams& params) {
  const MovingObject& lost = *objects.at(match.lost);
  const MovingObject& young = *objects.at(match.young);
  const auto since_m = DistanceIfSame_m(lost, other, params);
  if (const auto as_young_m = DistanceIfSame_m(other, young, params)) {
    if (IsSightBetween(other, lost)) return false;
    const auto as_lost_m = since_m ? since_m : DistanceIfSame_m(other, lost, params);
    return !as_lost_m || !IsLostOne(match, *as_young_m, *as_lost_m, objects, params);
  }
  if (since_m) return true;
  // What is to be joined now has matches of its own.
  return WasLostBefore(lost, other) && !IsToBeJoined(other, stamp) &&
         SeenAgain(lost, other, params).has_value();
}

bool IsSure(const Match& match, const std::vector<Match>& matches, const ObjectMap& objects,
            const SceneObjects& dropped_lately, Time stamp, const SceneParams& params) {
  const bool alone = std::ranges::count_if(matches, [&](const Match& other) {
                       return other.lost == match.lost || other.young == match.young;
                     }) == 1;
  // In a chain of three the first two go first.
  const bool lost_is_matched =
      std::ranges::any_of(matches, [&](const Match& other) { return other.young == match.lost; });
  if (!alone || lost_is_matched) return false;
  const auto is_rival = [&](const MovingObject& other) {
    return IsRival(match, other, objects, stamp, params);
  };
  const Time young_since = objects.at(match.young)->first_seen;
  const auto was_there = [&](const MovingObject& dropped) {
    return young_since - dropped.last_seen <= params.object_lifetime;
  };
  return std::ranges::none_of(dropped_lately,
                              [&](const auto& d) { return was_there(*d) && is_rival(*d); }) &&
         std::ranges::none_of(objects, [&](const auto& entry) {
           return entry.first != match.lost && entry.first != match.young &&
                  is_rival(*entry.second);
         });
}

// Whether they are two, by what was seen around either and by how far one would have been lifted
// onto the other: above 1 they are. Each doubt is told in parts of what is enough alone; they add
// up as errors do that have nothing to do with each other. What is known of the lost one is of many
// views, blurred by the errors of their poses: of it rays may pass more than of the new one, seen
// from one side.
double DoubtOf(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
               const Surroundings& around, const SceneParams& params) {
  constexpr double kEnoughOfLost = 0.1, kEnoughOfYoung = 0.025;
  return Eigen::Vector3d(
             ShareSeenThrough(lost, young, T_Y_L, around.at(young.id)) / kEnoughOfLost,
             ShareSeenThrough(young, lost, Inverse(T_Y_L), around.at(lost.id)) / kEnoughOfYoung,
             HeightOff(lost, young, T_Y_L, params))
      .norm();
}

// The same where beams are wide apart: the few there are tell half of what there is to doubt, and
// what is between them may be another's.
double DoubtIfSparse(double doubt, const MovingObject& young) {
  constexpr double kToldByFew = 0.5, kEnoughOfHeights = 0.15;
  return std::hypot(doubt / kToldByFew, ShareOfHeightsMissed(young) / kEnoughOfHeights);
}

bool AreTwo(const Match& match, const ObjectMap& objects, const LabelledCloud& cloud, Time stamp,
            const Surroundings& around, const SceneParams& params) {
  const MovingObject &lost = *objects.at(match.lost), &young = *objects.at(match.young);
  const double doubt = DoubtOf(lost, young, match.T_Y_L, around, params);
  if (doubt > 1) return true;
  return IsSeenSparsely(young, cloud, stamp, params) && DoubtIfSparse(doubt, young) > 1;
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

SceneObjects DroppedLately(const SceneObjects& dropped_before, const SceneObjects& before,
                           const ObjectMap& objects, Time stamp, const SceneParams& params) {
  SceneObjects dropped;
  for (const auto& object : dropped_before) {
    if (stamp - object->last_seen <= params.object_lifetime + kYoung) dropped.push_back(object);
  }
  for (const auto& object : before) {
    if (!object->given() && !objects.contains(object->id)) dropped.push_back(object);
  }
  return dropped;
}

std::size_t JoinSeenAgain(ObjectMap& objects, const SceneObjects& dropped_lately,
                          const LabelledCloud& cloud, Time stamp, const Surroundings& around,
                          const SceneParams& params, ThreadPool& pool) {
  const std::vector<Match> matches = FindMatches(objects, stamp, params);
  std::vector<Match> sure;
  for (Match match : matches) {
    if (!IsSure(match, matches, objects, dropped_lately, stamp, params)) continue;
    const MovingObject &lost = *objects.at(match.lost), &young = *objects.at(match.young);
    const VoxelMap& around_Y = around.at(match.young);
    match.T_Y_L = MutualFit(lost.map_O, young.map_O, around_Y, match.T_Y_L);
    if (FitsThere(lost, young, match.T_Y_L, params) &&
        !AreTwo(match, objects, cloud, stamp, around, params)) {
      sure.push_back(match);
    }
  }
  for (const Match& match : sure) {
    const MovingObject& lost = *objects.at(match.lost);
    const MovingObject& young = *objects.at(match.young);
    objects[match.lost] =
        std::make_shared<const MovingObject>(Joined(lost, young, match.T_Y_L, stamp, params, pool));
    objects.erase(match.young);
  }
  return sure.size();
}

}  // namespace clearway
