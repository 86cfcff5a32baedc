#include "scene/frame_objects.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "scene/contradicted_placement.h"
#include "scene/distrusted_motions.h"
#include "scene/dropped_object.h"
#include "scene/implausible_motions.h"
#include "scene/late_frame.h"
#include "scene/object_groups.h"
#include "scene/object_points.h"
#include "scene/other_ids.h"
#include "scene/point_placement.h"
#include "scene/report_issue.h"
#include "scene/sudden_jump.h"

namespace clearway {
namespace {

// When an object was last seen, or any that it forms one with; and whether the frame places one.
struct Sighting {
  Time last_seen;
  bool placed = false;
};

std::map<ObjectId, Sighting> SightingsOf(const SceneObjects& objects, const ClueMap& clues,
                                         Time stamp, const SceneParams& params) {
  std::map<ObjectId, Sighting> sightings;
  for (const auto& object : objects) {
    const auto clue = clues.find(object->id);
    sightings[object->id] = {object->last_seen,
                             clue != clues.end() && clue->second.Places() &&
                                 !OutOfReach(*object, clue->second, stamp, params)};
  }
  for (const ObjectGroup& group : GroupsOf(objects)) {
    Sighting of_group = sightings[group.front()];
    for (const ObjectId id : group) {
      of_group.last_seen = std::max(of_group.last_seen, sightings[id].last_seen);
      of_group.placed |= sightings[id].placed;
    }
    for (const ObjectId id : group) sightings[id] = of_group;
  }
  return sightings;
}

// What becomes of an object in a frame.
struct Continuation {
  bool goes_on = true;  // it is still the same one
  std::optional<ObjectIssue> issue = {};
};

// Given ones go on, and those that are not unseen for too long and, if they are seen again, are
// where they are known to be. Points alone may tell that.
Continuation ContinuationOf(const MovingObject& object, const Sighting& sighting,
                            const LabelledCloud& cloud, Time stamp, const SceneParams& params,
                            const FrameLimits& limits, ClueMap& clues) {
  if (object.given() || IsNewerThan(object, stamp)) return {};
  if (stamp - sighting.last_seen > params.object_lifetime) return {false};
  const auto clue = clues.find(object.id);
  if (clue == clues.end() || clue->second.points.empty()) return {};
  const bool goes_along = sighting.placed && !clue->second.Places();
  if (goes_along) return {};
  auto issue = PlaceByPoints(object, cloud, stamp, params, limits, clue->second);
  return {!issue && !OutOfReach(object, clue->second, stamp, params), issue};
}

// The object after the frame; none for a clue without points to an object of which the place is not
// known.
std::optional<MovingObject> Updated(const MovingObject* known, ObjectId id, const ObjectClue& clue,
                                    const LabelledCloud& cloud, Time stamp,
                                    const SceneParams& params, ThreadPool& pool) {
  const bool seen = !clue.points.empty();
  const bool placed = known != nullptr && !OutOfReach(*known, clue, stamp, params);
  if (!placed && !seen) return std::nullopt;
  MovingObject object = placed ? Moved(*known, cloud, clue, stamp, params)
                               : FirstSight(id, cloud, clue, stamp, params);
  if (seen) AddPoints(object, cloud, clue.points, stamp, params, pool);
  return object;
}

}  // namespace

ClueMap CluesOf(const Frame& frame, const LabelledCloud& cloud) {
  ClueMap clues;
  for (const ObjectMotion& motion : frame.motions) clues[motion.id].motion = &motion;
  for (const ObjectPose& pose : frame.poses) clues[pose.id].pose = &pose;
  for (const auto& [id, points] : cloud.object_hits) clues[id].points = points;
  return clues;
}

ObjectMap Continuing(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                     const SceneParams& params, const FrameLimits& limits, EarlierViews& views,
                     ClueMap& clues, VoxelMap& static_map_W, FrameReport& report) {
  const SceneObjects named = WithoutLapsedIds(objects, clues, stamp, params);
  LeaveOutImplausible(named, cloud, stamp, params, limits, clues, report);
  const std::set<ObjectId> two_after_all = GatherUnderFirstIds(named, clues, report);
  LeaveOutDistrusted(named, cloud, stamp, params, views, clues, report);
  LeaveOutContradicted(named, cloud, stamp, params, views, clues, report);
  LeaveOutJumps(named, stamp, params, clues, report);
  const std::set<ObjectId> smeared =
      LeaveOutMismatched(named, cloud, stamp, params, views, clues, report);
  const std::map<ObjectId, Sighting> sightings = SightingsOf(named, clues, stamp, params);
  ObjectMap continuing;
  for (const auto& object : named) {
    Continuation continuation{false};
    if (!two_after_all.contains(object->id) && !smeared.contains(object->id)) {
      continuation =
          ContinuationOf(*object, sightings.at(object->id), cloud, stamp, params, limits, clues);
    }
    if (continuation.issue) AddIssue(*continuation.issue, report);
    if (continuation.goes_on) {
      continuing[object->id] = object;
    } else {
      ForgetFreeSpaceOf(*object, static_map_W);
      ++report.objects_dropped;
    }
  }
  return continuing;
}

void UpdateObjects(const Frame& frame, const LabelledCloud& cloud, ClueMap clues,
                   const SceneParams& params, ThreadPool& pool, ObjectMap& objects,
                   FrameReport& report) {
  const auto update = [&](ObjectId id, const ObjectClue& clue) {
    const auto known = objects.find(id);
    if (known != objects.end() && IsNewerThan(*known->second, frame.stamp)) {
      report.motions_ignored += clue.Places();
      if (clue.points.empty()) return;
      known->second = std::make_shared<const MovingObject>(
          WithLatePoints(*known->second, cloud, clue, frame.stamp, params, pool));
      return;
    }
    std::optional<MovingObject> object =
        Updated(known == objects.end() ? nullptr : known->second.get(), id, clue, cloud,
                frame.stamp, params, pool);
    report.motions_ignored += !object.has_value();
    report.objects_created += object.has_value() && known == objects.end();
    report.objects_estimated += clue.T_W_O_estimated.has_value();
    const bool seen_now = object.has_value() && !clue.points.empty();
    report.objects_bridged += seen_now && !clue.Places() && object->bridged;
    if (object) objects[id] = std::make_shared<const MovingObject>(std::move(*object));
  };
  SetParts(frame.parts, objects);
  const ObjectMap before = objects;
  for (const auto& [id, clue] : clues) {
    if (clue.Places()) update(id, clue);
  }
  const std::vector<ObjectMotion> along = MotionsAlong(before, objects, clues, frame.stamp);
  ClueMap others;
  for (const auto& [id, clue] : clues) {
    if (!clue.Places()) others[id] = clue;
  }
  for (const ObjectMotion& motion : along) others[motion.id].motion = &motion;
  for (const auto& [id, clue] : others) update(id, clue);
  SetParts(frame.parts, objects);  // of those that are new
  GoAlong(clues, frame.stamp, params, objects);
}

}  // namespace clearway
