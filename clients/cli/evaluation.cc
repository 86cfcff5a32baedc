#include "cli/evaluation.h"

#include <utility>

namespace clearway::cli {

std::string NameOf(const TrueSource& source, ObjectId id) {
  const auto name = source.names.find(id);
  return name == source.names.end() ? "" : name->second;
}

std::vector<PredictionErrors> Together(
    const std::map<ObjectId, std::vector<PredictionErrors>>& predictions) {
  std::vector<PredictionErrors> all(kAhead.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].ahead = kAhead[i];
    for (const auto& [id, of_object] : predictions) all[i] += of_object[i];
  }
  return all;
}

std::vector<SolidOverlap> Together(const std::map<ObjectId, std::vector<SolidOverlap>>& solids) {
  std::vector<SolidOverlap> all(kAhead.size());
  for (const auto& [id, of_object] : solids) {
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += of_object[i];
  }
  return all;
}

Evaluator::Evaluator(const TrueSource& source, const std::vector<ObjectId>& unlabelled)
    : predictions_(source.truth, {kAhead.begin(), kAhead.end()}),
      boxes_(source.truth),
      ways_(source.truth, {kWaysAhead.begin(), kWaysAhead.end()}) {
  if (!unlabelled.empty()) {
    unlabelled_.emplace(source.truth, std::set<ObjectId>(unlabelled.begin(), unlabelled.end()));
  }
  const std::vector<Duration> ahead(kAhead.begin(), kAhead.end());
  if (source.simulation) {
    judge_.emplace(*source.simulation, ahead);
  } else if (!source.sizes_m.empty()) {
    box_judge_.emplace(source.truth, source.sizes_m, ahead);
  }
}

void Evaluator::Add(std::size_t k, const Frame& frame, const FrameReport& report, ScenePtr scene) {
  constexpr std::size_t kWaysEvery = 5;
  const std::size_t added = found_.frames++;
  // A late frame moves no object on: what it shows was scored with the newest frame.
  if (report.late_by == Duration::zero()) predictions_.Add(*scene);
  boxes_.Add(*scene);
  if (judge_) judge_->Add(k, frame, *scene);
  if (box_judge_) box_judge_->Add(added, frame, *scene);
  if (unlabelled_) unlabelled_->Add(frame, *scene);
  if (added % kWaysEvery == 0) ways_.Add(*scene, frame.T_W_S.translation);
  AddPoints(report);
  found_.notes.Add(frame);
  found_.notes.Add(report, frame.stamp);
  AddObjects(*scene);
  found_.scene = std::move(scene);
}

void Evaluator::AddPoints(const FrameReport& report) {
  found_.points.used += report.points_used;
  found_.points.not_finite += report.points_not_finite;
  found_.points.out_of_bounds += report.points_out_of_bounds;
  found_.points.ignored += report.points_ignored;
  found_.points.doubted += report.points_doubted;
  found_.points.frames_without += report.points_used == 0;
}

void Evaluator::AddObjects(const SceneSnapshot& scene) {
  if (!first_) first_ = scene.stamp;
  for (const auto& object : scene.objects) {
    if (object->last_seen != scene.stamp) continue;
    found_.growth[object->id].emplace_back(ToSeconds(scene.stamp - *first_),
                                           static_cast<double>(object->map_O.occupied_count()));
    found_.newest[object->id] = object;
  }
}

Evaluation Evaluator::Result() && {
  found_.predictions = predictions_.Errors();
  found_.sizes = boxes_.Fits();
  if (!ways_.ByObject().empty()) {
    found_.ways = ways_.Result();
    found_.ways_of = ways_.ByObject();
  }
  if (unlabelled_) found_.unlabelled = unlabelled_->Result();
  if (judge_) {
    found_.fits = judge_->Fits();
    found_.solids = judge_->overlaps();
    found_.static_fit = judge_->FitOfStatic(*found_.scene);
  }
  if (box_judge_) {
    found_.fits = box_judge_->Fits();
    found_.solids = box_judge_->overlaps();
    found_.residue = box_judge_->ResidueIn(*found_.scene);
  }
  return std::move(found_);
}

}  // namespace clearway::cli
