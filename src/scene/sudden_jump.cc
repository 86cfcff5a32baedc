#include "scene/sudden_jump.h"

#include <optional>

#include "scene/box_heading.h"
#include "scene/late_frame.h"
#include "scene/object_motion.h"
#include "scene/report_issue.h"

namespace clearway {
namespace {

std::optional<ObjectIssue> JumpOf(const MovingObject& object, Time stamp, const SceneParams& params,
                                  const ObjectClue& clue) {
  // Predictions are off by their 95 % bound seldom, by ten times as much never; a bound that
  // follows from very even poses may be too narrow for a sudden move.
  constexpr double kManyBounds = 10, kSlack_m = 1, kAcceleration_mps2 = 30;
  constexpr std::size_t kFewPoints = 3;
  const bool placed_by_points = object.estimated && object.reported;
  if (clue.points.empty() || object.bridged || placed_by_points) return std::nullopt;
  const std::optional<Pose> stated = StatedPose(object, clue, stamp, params);
  if (!stated) return std::nullopt;
  const PredictedPose predicted = PredictPose(object, stamp, params.horizon);
  if (predicted.beyond_horizon_radius_m) return std::nullopt;
  const double ahead_s = ToSeconds(stamp - object.t_k());

  const Eigen::Vector3d center_O = CenterOf(*object.solid);
  const double off_m = (*stated * center_O - predicted.T_W_O * center_O).norm();
  const double limit_m = kManyBounds * object.bound.At(ahead_s) + kSlack_m +
                         0.5 * kAcceleration_mps2 * ahead_s * ahead_s;
  if (object.velocity_O && off_m > limit_m && clue.points.size() >= kFewPoints) {
    return ObjectIssue{ObjectIssueKind::kJumped, object.id, off_m, limit_m};
  }
  const double turn_rad = stated->rotation.angularDistance(predicted.T_W_O.rotation);
  const double limit_rad = MaxTurn_rad(ahead_s);
  if (turn_rad <= limit_rad || stamp - object.t_k() > kMaxGapOfHeadings) return std::nullopt;
  return ObjectIssue{ObjectIssueKind::kTurnTooLarge, object.id, turn_rad, limit_rad};
}

}  // namespace

void LeaveOutJumps(const SceneObjects& objects, Time stamp, const SceneParams& params,
                   ClueMap& clues, FrameReport& report) {
  for (const auto& object : objects) {
    const auto clue = clues.find(object->id);
    if (clue == clues.end() || object->given() || IsNewerThan(*object, stamp)) continue;
    const auto issue = JumpOf(*object, stamp, params, clue->second);
    if (!issue) continue;
    AddIssue(*issue, report);
    clue->second.motion = nullptr;
    clue->second.pose = nullptr;
  }
}

}  // namespace clearway
