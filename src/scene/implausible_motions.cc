#include "scene/implausible_motions.h"

#include <algorithm>
#include <map>
#include <optional>

#include "scene/mended_pose.h"
#include "scene/object_motion.h"
#include "scene/report_issue.h"

namespace clearway {
namespace {

// Whether a position moves faster than anything, within the shortest step that tells a velocity.
std::optional<ObjectIssue> TooFast(ObjectId id, const Eigen::Vector3d& from_W,
                                   const Eigen::Vector3d& to_W, Duration within) {
  const double speed_mps = (to_W - from_W).norm() / ToSeconds(std::max(within, kShortestStep));
  if (speed_mps <= kMaxSpeed_mps) return std::nullopt;
  return ObjectIssue{ObjectIssueKind::kMotionTooFast, id, speed_mps, kMaxSpeed_mps};
}

// Whether a motion starts long before anybody saw the object, as if its stamp were of another
// clock.
std::optional<ObjectIssue> StartsTooEarly(const ObjectMotion& motion, Time first_seen) {
  constexpr Duration kLongest = std::chrono::seconds(1);
  const Duration before = first_seen - motion.from;
  if (before <= kLongest + kNoGap) return std::nullopt;
  return ObjectIssue{ObjectIssueKind::kStartsTooEarly, motion.id, ToSeconds(before),
                     ToSeconds(kLongest)};
}

// What is wrong with the motion of an object that the scene knows.
std::optional<ObjectIssue> IssueOf(const ObjectMotion& motion, const MovingObject& known,
                                   Time stamp, const SceneParams& params,
                                   const FrameLimits& limits) {
  if (!known.given()) {
    const auto issue = StartsTooEarly(motion, std::min(stamp, known.first_seen));
    if (issue) return issue;
  }
  const Pose T_W_from = StartOf(motion, known, stamp, params);
  const Pose T_W_to = motion.H_W * T_W_from;
  if (const double reach_m = LargestCoordinate(T_W_to); reach_m > limits.max_coordinate_m) {
    return ObjectIssue{ObjectIssueKind::kMotionTooFar, motion.id, reach_m, limits.max_coordinate_m};
  }
  return TooFast(motion.id, T_W_from.translation, T_W_to.translation, stamp - motion.from);
}

// What is wrong with a motion, whatever it moves.
std::optional<ObjectIssue> IssueOf(const ObjectMotion& motion, const FrameLimits& limits) {
  const double carried_m = LargestCoordinate(motion.H_W);
  if (carried_m > 2 * limits.max_coordinate_m) {
    return ObjectIssue{ObjectIssueKind::kMotionTooFar, motion.id, carried_m,
                       limits.max_coordinate_m};
  }
  const double turn_rad = Log(motion.H_W).angular.norm();
  if (turn_rad <= kMaxTurn_rad) return std::nullopt;
  return ObjectIssue{ObjectIssueKind::kTurnTooLarge, motion.id, turn_rad, kMaxTurn_rad};
}

std::optional<ObjectIssue> TooFar(ObjectId id, const Pose& pose_W, const FrameLimits& limits) {
  const double reach_m = LargestCoordinate(pose_W);
  if (reach_m <= limits.max_coordinate_m) return std::nullopt;
  return ObjectIssue{ObjectIssueKind::kMotionTooFar, id, reach_m, limits.max_coordinate_m};
}

// `known` is null if the scene does not have the object.
std::optional<ObjectIssue> IssueOf(const ObjectPose& pose, const MovingObject* known, Time stamp,
                                   const FrameLimits& limits) {
  if (const auto issue = TooFar(pose.id, pose.T_W_B, limits)) return issue;
  if (known == nullptr || known->given() || !known->T_B_O) return std::nullopt;
  const StampedPose& last = known->history.back();
  const Pose T_W_O = pose.T_W_B * *known->T_B_O;
  if (const auto issue = TooFar(pose.id, T_W_O, limits)) return issue;
  return TooFast(pose.id, last.T_W_O.translation, T_W_O.translation,
                 std::chrono::abs(stamp - last.stamp));
}

// `known` is null if the scene does not have the object.
std::optional<ObjectIssue> IssueOf(const ObjectClue& clue, const MovingObject* known,
                                   const LabelledCloud& cloud, Time stamp,
                                   const SceneParams& params, const FrameLimits& limits) {
  if (clue.motion == nullptr) {
    return clue.pose ? IssueOf(*clue.pose, known, stamp, limits) : std::nullopt;
  }
  const ObjectMotion& motion = *clue.motion;
  if (const auto issue = IssueOf(motion, limits)) return issue;
  if (known != nullptr) return IssueOf(motion, *known, stamp, params, limits);
  if (clue.points.empty()) return std::nullopt;
  if (const auto issue = StartsTooEarly(motion, stamp)) return issue;
  const Eigen::Vector3d p_W = cloud.ends_W[clue.points.front()].cast<double>();
  return TooFast(motion.id, Inverse(motion.H_W) * p_W, p_W, stamp - motion.from);
}

}  // namespace

double LargestCoordinate(const Pose& pose) { return pose.translation.cwiseAbs().maxCoeff(); }

void LeaveOutImplausible(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                         const SceneParams& params, const FrameLimits& limits, ClueMap& clues,
                         FrameReport& report) {
  std::map<ObjectId, const MovingObject*> by_name;
  for (const auto& object : objects) {
    for (const ObjectId name : object->Ids()) by_name[name] = object.get();
  }
  for (auto clue = clues.begin(); clue != clues.end();) {
    ObjectClue& of_object = clue->second;
    const auto known = by_name.find(clue->first);
    const auto issue = IssueOf(of_object, known == by_name.end() ? nullptr : known->second, cloud,
                               stamp, params, limits);
    if (issue) {
      AddIssue(*issue, report);
      of_object.motion = nullptr;
      of_object.pose = nullptr;
    }
    clue = of_object.Places() || !of_object.points.empty() ? std::next(clue) : clues.erase(clue);
  }
}

}  // namespace clearway
