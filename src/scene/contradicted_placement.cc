#include "scene/contradicted_placement.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/late_frame.h"
#include "scene/prediction_gate.h"
#include "scene/ray_evidence.h"
#include "scene/report_issue.h"

namespace clearway {
namespace {

constexpr double kSlack_m = 1;

// An object's points of a frame, and where the frame says that it is.
struct Sight {
  const LabelledCloud& cloud;
  std::span<const std::uint32_t> points;
  std::vector<Eigen::Vector3d> points_W;
  Pose T_W_O;
  GateOffset offset;  // from there
};

// What they are off by, and more than what, by all that speaks against that pose.
struct Excess {
  double off_m = 0, limit_m = 0;
  bool by_prediction = false;  // alone
};

// By the prediction: the points fit the object there, or better.
std::optional<Excess> AgainstPrediction(const MovingObject& object, const Sight& sight, Time stamp,
                                        double near_m, double mended_m, const SceneParams& params) {
  constexpr double kManyBounds = 3;
  constexpr double kNoise_m = 0.15;  // of poses that were even so far
  constexpr double kWide_m = 0.5;    // more than a lorry by the noise of its heading
  const double off_m = sight.offset.off_W.norm();
  const Pose T_W_predicted = PredictPose(object, stamp, params.horizon).T_W_O;
  const double bound_m = object.bound.At(ToSeconds(stamp - object.LastPose().stamp));
  const GateOffset predicted = OffsetFrom(object, T_W_predicted, sight.points_W);
  const double predicted_off_m = predicted.off_W.norm();
  const bool is_as_predicted = MeetsPrediction(predicted, bound_m) && 2 * predicted_off_m < off_m;
  if (off_m > near_m && is_as_predicted) return Excess{off_m, near_m, true};
  const double two_voxels_m = 2 * object.map_O.grid().resolution_m();
  if (predicted.wider_m > two_voxels_m) return std::nullopt;
  // Turned by a right angle, a car spreads beyond its box on both sides.
  const double beyond_m = 0.5 * sight.offset.wider_m, wide_m = kWide_m + mended_m;
  if (beyond_m > wide_m) return Excess{beyond_m, wide_m};
  const double seldom_m = kManyBounds * bound_m + kNoise_m + mended_m;
  const bool is_seldom = off_m > seldom_m && predicted_off_m == 0;
  return is_seldom ? std::optional(Excess{off_m, seldom_m, true}) : std::nullopt;
}

// By rays: they go on through the object.
std::optional<Excess> AgainstRays(const MovingObject& object, const Sight& sight, double mended_m,
                                  const SceneParams& params) {
  const double off_m = sight.offset.off_W.norm();
  const double beside_m = 2 * sight.offset.half_size_m + kSlack_m + mended_m;
  const bool is_passed_through =
      off_m > beside_m && IsPassedThrough(object, sight.T_W_O, sight.points, sight.cloud, params);
  return is_passed_through ? std::optional(Excess{off_m, beside_m}) : std::nullopt;
}

std::optional<Excess> ExcessOf(const MovingObject& object, const Sight& sight, Time stamp,
                               bool may_be_predicted, const SceneParams& params) {
  constexpr double kManySigmas = 3;  // of a pose that is mended
  // What comes into sight at the other end of an object may lie so far from what was seen of it.
  constexpr double kLongestGap_m = 30;
  constexpr std::size_t kManyPoints = 20;
  const double off_m = sight.offset.off_W.norm();
  const double mended_m = kManySigmas * params.object_pose_error_m;
  const double near_m = sight.offset.half_size_m + kSlack_m + mended_m;
  if (off_m > near_m + kLongestGap_m && sight.points.size() >= kManyPoints) {
    return Excess{off_m, near_m};
  }
  const auto excess = AgainstPrediction(object, sight, stamp, near_m, mended_m, params);
  if (excess && (may_be_predicted || !excess->by_prediction)) return excess;
  return off_m > 0 ? AgainstRays(object, sight, mended_m, params) : std::nullopt;
}

std::optional<Excess> ContradictionOf(const MovingObject& object, const LabelledCloud& cloud,
                                      Time stamp, bool may_be_predicted, const SceneParams& params,
                                      const ObjectClue& clue) {
  constexpr std::size_t kFewPoints = 3;  // may all be labelled wrongly
  if (clue.points.size() < kFewPoints) return std::nullopt;
  const std::optional<Pose> T_W_O = StatedPose(object, clue, stamp, params);
  if (!T_W_O) return std::nullopt;
  Sight sight{cloud, clue.points, EndsOf(cloud, clue.points), *T_W_O, {}};
  sight.offset = OffsetFrom(object, *T_W_O, sight.points_W);
  const double four_voxels_m = 4 * object.map_O.grid().resolution_m();
  const bool fits = sight.offset.off_W.isZero(0) && sight.offset.wider_m <= four_voxels_m;
  return fits ? std::nullopt : ExcessOf(object, sight, stamp, may_be_predicted, params);
}

}  // namespace

void LeaveOutContradicted(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                          const SceneParams& params, EarlierViews& views, ClueMap& clues,
                          FrameReport& report) {
  for (const auto& object : objects) {
    const auto clue = clues.find(object->id);
    if (clue == clues.end() || object->given() || IsNewerThan(*object, stamp)) continue;
    if (!clue->second.Places()) continue;
    const auto excess =
        ContradictionOf(*object, cloud, stamp, views.MayDoubt(object->id), params, clue->second);
    views.NoteDoubt(object->id, stamp, excess && excess->by_prediction);
    if (!excess) continue;
    AddIssue({ObjectIssueKind::kContradicted, object->id, excess->off_m, excess->limit_m}, report);
    clue->second.motion = nullptr;
    clue->second.pose = nullptr;
  }
}

}  // namespace clearway
