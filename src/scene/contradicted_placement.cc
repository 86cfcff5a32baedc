#include "scene/contradicted_placement.h"

#include <optional>

#include "scene/late_frame.h"
#include "scene/passed_through.h"
#include "scene/prediction_gate.h"
#include "scene/report_issue.h"

namespace clearway {
namespace {

std::optional<ObjectIssue> ContradictionOf(const MovingObject& object, const LabelledCloud& cloud,
                                           Time stamp, const SceneParams& params,
                                           const ObjectClue& clue) {
  constexpr double kSlack_m = 1;
  constexpr double kManySigmas = 3;  // of a pose that is mended
  constexpr double kManyBounds = 3;  // where the points fit the prediction
  // What comes into sight at the other end of an object may lie so far from what was seen of it.
  constexpr double kLongestGap_m = 30;
  // A few points may all be labelled wrongly.
  constexpr std::size_t kFewPoints = 3, kManyPoints = 20;
  if (clue.points.size() < kFewPoints) return std::nullopt;
  const std::optional<Pose> T_W_O = StatedPose(object, clue, stamp, params);
  if (!T_W_O) return std::nullopt;

  const std::vector<Eigen::Vector3d> points_W = EndsOf(cloud, clue.points);
  const GateOffset stated = OffsetFrom(object, *T_W_O, points_W);
  const double off_m = stated.off_W.norm();
  if (off_m == 0) return std::nullopt;
  const auto contradicted = [&](double limit_m) {
    return ObjectIssue{ObjectIssueKind::kContradicted, object.id, off_m, limit_m};
  };
  const double slack_m = kManySigmas * params.object_pose_error_m;
  const double near_m = stated.half_size_m + kSlack_m + slack_m;
  const bool is_far = off_m > near_m + kLongestGap_m && clue.points.size() >= kManyPoints;
  if (is_far) return contradicted(near_m);

  const Pose T_W_predicted = PredictPose(object, stamp, params.horizon).T_W_O;
  const double bound_m = object.bound.At(ToSeconds(stamp - object.LastPose().stamp));
  const GateOffset predicted = OffsetFrom(object, T_W_predicted, points_W);
  const double predicted_off_m = predicted.off_W.norm();
  const bool is_as_predicted = MeetsPrediction(predicted, bound_m) && 2 * predicted_off_m < off_m;
  if (off_m > near_m && is_as_predicted) return contradicted(near_m);
  const double seldom_m = kManyBounds * bound_m + slack_m;
  if (off_m > seldom_m && predicted_off_m == 0) return contradicted(seldom_m);
  const double beside_m = 2 * stated.half_size_m + slack_m;
  if (off_m > beside_m && IsPassedThrough(object, *T_W_O, cloud, params)) {
    return contradicted(beside_m);
  }
  return std::nullopt;
}

}  // namespace

void LeaveOutContradicted(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                          const SceneParams& params, ClueMap& clues, FrameReport& report) {
  for (const auto& object : objects) {
    const auto clue = clues.find(object->id);
    if (clue == clues.end() || object->given() || IsNewerThan(*object, stamp)) continue;
    const auto issue = ContradictionOf(*object, cloud, stamp, params, clue->second);
    if (!issue) continue;
    AddIssue(*issue, report);
    clue->second.motion = nullptr;
    clue->second.pose = nullptr;
  }
}

}  // namespace clearway
