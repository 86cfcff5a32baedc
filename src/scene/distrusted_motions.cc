#include "scene/distrusted_motions.h"

#include <map>
#include <optional>

#include "scene/report_issue.h"

namespace clearway {
namespace {

// Of the clues that say where an object goes, those of given objects apart; each with the bound of
// its predictions, as far as these follow from what was said.
std::map<ObjectId, PositionBound> Placed(const SceneObjects& objects, const ClueMap& clues) {
  std::map<ObjectId, PositionBound> bounds;
  for (const auto& [id, clue] : clues) {
    if (clue.Places()) bounds[id];
  }
  for (const auto& object : objects) {
    const auto bound = bounds.find(object->id);
    if (bound == bounds.end()) continue;
    if (object->given()) {
      bounds.erase(bound);
    } else if (!object->bridged && !object->estimated) {
      bound->second = object->bound;
    }
  }
  return bounds;
}

// What speaks against the clue, if it is left out.
std::optional<Mismatch> LeaveOutIfMismatched(ObjectId id, const PositionBound& bound,
                                             const LabelledCloud& cloud, Time stamp,
                                             const SceneParams& params, EarlierViews& views,
                                             ClueMap& clues, FrameReport& report) {
  ObjectClue& clue = clues.at(id);
  const auto mismatch = views.Judge(id, clue, bound, cloud, stamp, params);
  if (!mismatch) return std::nullopt;
  AddIssue({ObjectIssueKind::kContradicted, id, mismatch->off_m, mismatch->limit_m}, report);
  clue.motion = nullptr;
  clue.pose = nullptr;
  if (clue.points.empty()) clues.erase(id);
  return mismatch;
}

}  // namespace

void LeaveOutDistrusted(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                        const SceneParams& params, EarlierViews& views, ClueMap& clues,
                        FrameReport& report) {
  if (views.IsLate(stamp)) return;
  for (const auto& [id, bound] : Placed(objects, clues)) {
    if (!views.Distrusts(id)) continue;
    LeaveOutIfMismatched(id, bound, cloud, stamp, params, views, clues, report);
  }
}

std::set<ObjectId> LeaveOutMismatched(const SceneObjects& objects, const LabelledCloud& cloud,
                                      Time stamp, const SceneParams& params, EarlierViews& views,
                                      ClueMap& clues, FrameReport& report) {
  std::set<ObjectId> begin_anew;
  if (views.IsLate(stamp)) return begin_anew;
  std::map<ObjectId, Mismatch> mismatches;
  for (const auto& [id, bound] : Placed(objects, clues)) {
    const auto mismatch =
        LeaveOutIfMismatched(id, bound, cloud, stamp, params, views, clues, report);
    if (mismatch) mismatches[id] = *mismatch;
  }
  for (const auto& object : objects) {
    const auto entry = mismatches.find(object->id);
    const bool is_smeared = object->pose_source() == PoseSource::kReported;
    if (entry == mismatches.end() || !is_smeared) continue;
    const auto& [off_m, limit_m] = entry->second;
    AddIssue({ObjectIssueKind::kRestarted, object->id, off_m, limit_m}, report);
    begin_anew.insert(object->id);
  }
  return begin_anew;
}

}  // namespace clearway
