#include "scene/points_of_given.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "scene/report_issue.h"

namespace clearway {
namespace {

// What the points, at least one, are off by if that is too much: the median of their distances from
// the box about the object.
std::optional<ObjectIssue> WhyOthers(const MovingObject& object, const ObjectClue& clue,
                                     const LabelledCloud& cloud, Time stamp,
                                     const SceneParams& params) {
  constexpr double kSlack_m = 1;
  const Pose T_W_O = StatedPose(object, clue, stamp, params)
                         .value_or(PredictPose(object, stamp, params.horizon).T_W_O);
  const Pose T_O_W = Inverse(T_W_O);
  const Aabb& box_O = object.solid->box_O;
  std::vector<double> off_m;
  for (const Eigen::Vector3d& p_W : EndsOf(cloud, clue.points)) {
    const Eigen::Vector3d p_O = T_O_W * p_W;
    off_m.push_back((p_O - p_O.cwiseMax(box_O.min).cwiseMin(box_O.max)).norm());
  }
  const auto median = off_m.begin() + static_cast<std::ptrdiff_t>(off_m.size() / 2);
  std::ranges::nth_element(off_m, median);
  const double limit_m = kSlack_m + object.bound.At(ToSeconds(stamp - object.LastPose().stamp));
  if (*median <= limit_m) return std::nullopt;
  return ObjectIssue{ObjectIssueKind::kContradicted, object.id, *median, limit_m};
}

// Counted only if a motion or pose is left out.
void NoteElsewhere(const ObjectIssue& issue, const ObjectClue& clue, FrameReport& report) {
  if (clue.Places()) return AddIssue(issue, report);
  if (report.issues.size() < kMaxObjectIssues) report.issues.push_back(issue);
}

}  // namespace

void LeaveOutPointsOfGiven(const SceneObjects& objects, Time stamp, const SceneParams& params,
                           LabelledCloud& cloud, ClueMap& clues, FrameReport& report) {
  for (const auto& object : objects) {
    const auto clue = clues.find(object->id);
    if (!object->given() || clue == clues.end() || clue->second.points.empty()) continue;
    if (const auto issue = WhyOthers(*object, clue->second, cloud, stamp, params)) {
      NoteElsewhere(*issue, clue->second, report);
      for (const std::uint32_t i : clue->second.points) {
        cloud.kinds[i] = RayEnd::kHit;
        cloud.labels[i] = kStaticLabel;
      }
      clue->second.motion = nullptr;
      clue->second.pose = nullptr;
    } else {
      report.points_given += clue->second.points.size();
    }
    clue->second.points = {};
    cloud.object_hits.erase(object->id);
    if (!clue->second.Places()) clues.erase(clue);
  }
}

}  // namespace clearway
