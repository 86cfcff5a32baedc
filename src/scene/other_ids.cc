#include "scene/other_ids.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "scene/mutual_fit.h"
#include "scene/other_shape.h"
#include "scene/reidentification.h"
#include "scene/report_issue.h"
#include "scene/rivals.h"
#include "scene/same_object.h"
#include "scene/sparse_sight.h"

namespace clearway {
namespace {

// Those of parts and of what they are parts of.
std::set<ObjectId> IdsInGroups(const ObjectMap& objects) {
  std::set<ObjectId> ids;
  for (const auto& [id, object] : objects) {
    if (object->part_of != kStaticLabel) ids.insert({id, object->part_of});
  }
  return ids;
}

// As what its other ids name. It must be an older one.
MovingObject Without(ObjectId older_id, MovingObject object) {
  std::vector<ObjectId> ids = object.Ids();
  const auto at = std::ranges::find(ids, older_id) - ids.begin();
  object.older_ids_told.erase(object.older_ids_told.begin() + at);
  ids.erase(ids.begin() + at);
  object.id = ids.front();
  object.also.assign(ids.begin() + 1, ids.end());
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

bool IsSure(const Match& match, const std::vector<Match>& matches, const ObjectMap& objects,
            const SceneObjects& dropped_lately, Time stamp, const SceneParams& params) {
  const bool alone = std::ranges::count_if(matches, [&](const Match& other) {
                       return other.lost == match.lost || other.young == match.young;
                     }) == 1;
  // In a chain of three the first two go first.
  const bool lost_is_matched =
      std::ranges::any_of(matches, [&](const Match& other) { return other.young == match.lost; });
  if (!alone || lost_is_matched) return false;
  const MovingObject &lost = *objects.at(match.lost), &young = *objects.at(match.young);
  const auto is_rival = [&](const MovingObject& other) {
    return IsRival(other, lost, young, stamp, params);
  };
  const auto was_there = [&](const MovingObject& dropped) {
    return young.first_seen - dropped.last_seen <= params.object_lifetime;
  };
  return std::ranges::none_of(dropped_lately,
                              [&](const auto& d) { return was_there(*d) && is_rival(*d); }) &&
         std::ranges::none_of(objects, [&](const auto& entry) {
           return entry.first != match.lost && entry.first != match.young &&
                  is_rival(*entry.second);
         });
}

// How much there is to doubt that they are one, by what was seen around either and by how far one
// would have been lifted onto the other. Each doubt is told in parts of what is enough alone; they
// add up as errors do that have nothing to do with each other. What is known of the lost one is of
// many views, blurred by the errors of their poses: of it rays may pass more than of the new one,
// seen from one side.
double DoubtOf(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
               const Surroundings& around, const SceneParams& params) {
  constexpr double kEnoughOfLost = 0.1, kEnoughOfYoung = 0.025;
  return Eigen::Vector3d(
             ShareSeenThrough(lost, young, T_Y_L, around.at(young.id)) / kEnoughOfLost,
             ShareSeenThrough(young, lost, Inverse(T_Y_L), around.at(lost.id)) / kEnoughOfYoung,
             HeightOff(lost, young, T_Y_L, params))
      .norm();
}

// Whether there is too much of it (MayBeDoubted). What is between beams may be another's: so
// heights of the new one that no beam has met are a doubt, too; and where beams are far apart, in
// voxels, the few there are tell a part alone of what there is to doubt, of a sensor with few of
// them half.
bool AreTwo(const Match& match, const ObjectMap& objects, const LabelledCloud& cloud, Time stamp,
            const Surroundings& around, const SceneParams& params) {
  constexpr double kEnoughOfHeights = 0.3, kFarApart_voxels = 1.5;
  constexpr double kFew_rad = 0.6 * std::numbers::pi / 180, kOfFew = 2;
  const MovingObject &lost = *objects.at(match.lost), &young = *objects.at(match.young);
  const double doubt = DoubtOf(lost, young, match.T_Y_L, around, params);
  const double may_be = MayBeDoubted(young);
  if (doubt > may_be) return true;
  const BeamsApart apart = BeamsApartAt(young, cloud, stamp, params);
  const double of_few = apart.rad > kFew_rad ? kOfFew : 1;
  const double of_far = apart.m / (kFarApart_voxels * params.object_resolution_m);
  return std::hypot(std::max(of_few, of_far) * doubt,
                    of_few * ShareOfHeightsMissed(young) / kEnoughOfHeights) > may_be;
}

// Gives the object's clue the motion or pose that counts: its own, which came under the id with
// most points, else that under the newest id. The report names the others.
void TakePlacement(const MovingObject& object, const ClueMap& clues, ObjectClue& clue,
                   FrameReport& report) {
  const ObjectId own = clue.named_as.front();
  const std::vector<ObjectId> ids = object.Ids();
  for (auto id = ids.rbegin(); id != ids.rend(); ++id) {
    const auto other = clues.find(*id);
    if (*id == own || other == clues.end() || !other->second.Places()) continue;
    if (clue.Places()) {
      AddIssue({ObjectIssueKind::kMotionConflict, *id}, report);
      continue;
    }
    clue.motion = other->second.motion;
    clue.pose = other->second.pose;
    clue.named_as.push_back(*id);
  }
}

}  // namespace

SceneObjects WithoutLapsedIds(SceneObjects objects, const ClueMap& clues, Time stamp,
                              const SceneParams& params) {
  for (auto& object : objects) {
    const std::vector<ObjectId> ids = object->Ids();
    const std::vector<Time> told = object->older_ids_told;
    for (std::size_t i = 0; i < told.size(); ++i) {
      if (stamp - told[i] <= params.object_lifetime || !clues.contains(ids[i])) continue;
      object = std::make_shared<const MovingObject>(Without(ids[i], *object));
    }
  }
  return objects;
}

std::set<ObjectId> GatherUnderFirstIds(const SceneObjects& objects, ClueMap& clues,
                                       FrameReport& report) {
  std::set<ObjectId> two_after_all;
  for (const auto& object : objects) {
    if (object->also.empty()) continue;
    std::vector<ClueMap::iterator> told;  // that with most points last
    for (const ObjectId id : object->Ids()) {
      if (const auto clue = clues.find(id); clue != clues.end()) told.push_back(clue);
    }
    std::ranges::stable_sort(told, {}, [](const auto& clue) { return clue->second.points.size(); });
    if (told.empty()) continue;
    if (told.size() > 1 && told[told.size() - 2]->second.points.size() >= kNotStray) {
      two_after_all.insert(object->id);
      continue;
    }
    ObjectClue clue = told.back()->second;
    clue.named_as = {told.back()->first};
    TakePlacement(*object, clues, clue, report);
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
