#include "scene/implausible_motions.h"

#include <map>
#include <optional>

#include "scene/report_issue.h"

namespace clearway {
namespace {

// What is wrong with the motion of an object; `known` is null if the scene does not have it.
std::optional<ObjectIssue> IssueOf(const ObjectMotion& motion, const MovingObject* known,
                                   Time stamp, const SceneParams& params,
                                   const FrameLimits& limits) {
  const double limit_m = limits.max_coordinate_m;
  const double carried_m = LargestCoordinate(motion.H_W);
  if (carried_m > 2 * limit_m) {
    return ObjectIssue{ObjectIssueKind::kMotionTooFar, motion.id, carried_m, limit_m};
  }
  if (const double turn_rad = Log(motion.H_W).angular.norm(); turn_rad > kMaxTurn_rad) {
    return ObjectIssue{ObjectIssueKind::kTurnTooLarge, motion.id, turn_rad, kMaxTurn_rad};
  }
  if (known == nullptr) return std::nullopt;
  const Pose T_W_from = StartOf(motion, *known, stamp, params);
  const double reach_m = LargestCoordinate(motion.H_W * T_W_from);
  if (reach_m <= limit_m) return std::nullopt;
  return ObjectIssue{ObjectIssueKind::kMotionTooFar, motion.id, reach_m, limit_m};
}

}  // namespace

double LargestCoordinate(const Pose& pose) { return pose.translation.cwiseAbs().maxCoeff(); }

void LeaveOutImplausible(const SceneObjects& objects, Time stamp, const SceneParams& params,
                         const FrameLimits& limits, ClueMap& clues, FrameReport& report) {
  std::map<ObjectId, const MovingObject*> by_name;
  for (const auto& object : objects) {
    for (const ObjectId name : object->Ids()) by_name[name] = object.get();
  }
  for (auto clue = clues.begin(); clue != clues.end();) {
    ObjectClue& of_object = clue->second;
    if (of_object.motion != nullptr) {
      const auto known = by_name.find(clue->first);
      const auto issue =
          IssueOf(*of_object.motion, known == by_name.end() ? nullptr : known->second, stamp,
                  params, limits);
      if (issue) {
        AddIssue(*issue, report);
        of_object.motion = nullptr;
      }
    }
    clue = of_object.Places() || !of_object.points.empty() ? std::next(clue) : clues.erase(clue);
  }
}

}  // namespace clearway
