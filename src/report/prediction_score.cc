#include "clearway/report/prediction_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clearway {

namespace {

double QuantileOf(const std::vector<double>& ascending, double share) {
  if (ascending.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<double>(ascending.size() - 1);
  return ascending[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * last))];
}

void MergeInto(std::vector<double>& all, const std::vector<double>& ascending) {
  const auto middle = static_cast<std::ptrdiff_t>(all.size());
  all.insert(all.end(), ascending.begin(), ascending.end());
  std::inplace_merge(all.begin(), all.begin() + middle, all.end());
}

// The true box, at that version's time, of an object whose predictions are scored.
std::optional<TrueBox> ScoredBox(const MovingObject& object, const SceneSnapshot& scene,
                                 const Truth& truth) {
  if (object.t_k() != scene.stamp || object.bridged) return std::nullopt;
  return BoxOf(truth, object.id, scene.stamp);
}

}  // namespace

double PredictionErrors::Quantile(double share) const { return QuantileOf(errors_m, share); }

double PredictionErrors::MedianBound() const { return QuantileOf(bounds_m, 0.5); }

double PredictionErrors::TurnQuantile_rad(double share) const {
  return QuantileOf(turns_rad, share);
}

PredictionErrors& PredictionErrors::operator+=(const PredictionErrors& other) {
  MergeInto(errors_m, other.errors_m);
  MergeInto(bounds_m, other.bounds_m);
  MergeInto(turns_rad, other.turns_rad);
  within += other.within;
  return *this;
}

PredictionScore::PredictionScore(Truth truth, std::vector<Duration> ahead)
    : truth_(std::move(truth)), ahead_(std::move(ahead)) {}

void ForEachPrediction(const SceneSnapshot& scene, const Truth& truth,
                       const std::vector<Duration>& ahead,
                       const std::function<void(const ScoredPrediction&)>& visit) {
  for (const auto& object : scene.objects) {
    const auto now = ScoredBox(*object, scene, truth);
    if (!now) continue;
    const Pose T_O_B = Inverse(object->history.back().T_W_O) * now->T_W_B;
    for (std::size_t i = 0; i < ahead.size(); ++i) {
      const Time then = scene.stamp + ahead[i];
      const auto box = then > truth.end ? std::nullopt : BoxOf(truth, object->id, then);
      if (!box) continue;
      const Pose predicted_W = PredictPose(*object, then, scene.params.horizon).T_W_O * T_O_B;
      visit({*object, i, (predicted_W.translation - box->T_W_B.translation).norm(),
             predicted_W.rotation.angularDistance(box->T_W_B.rotation)});
    }
  }
}

void PredictionScore::Add(const SceneSnapshot& scene) {
  for (const auto& object : scene.objects) {  // also those of which no prediction can be scored
    if (ScoredBox(*object, scene, truth_)) errors_.try_emplace(object->id, ahead_.size());
  }
  ForEachPrediction(scene, truth_, ahead_, [&](const ScoredPrediction& prediction) {
    const MovingObject& object = prediction.object;
    PredictionErrors& errors = errors_.at(object.id)[prediction.ahead];
    const double bound_m = object.bound.At(ToSeconds(ahead_[prediction.ahead]));
    errors.errors_m.push_back(prediction.error_m);
    errors.bounds_m.push_back(bound_m);
    errors.within += prediction.error_m <= bound_m;
    errors.turns_rad.push_back(prediction.turn_rad);
  });
}

std::map<ObjectId, std::vector<PredictionErrors>> PredictionScore::Errors() const {
  auto result = errors_;
  for (auto& [id, of_object] : result) {
    for (std::size_t i = 0; i < ahead_.size(); ++i) {
      of_object[i].ahead = ahead_[i];
      std::ranges::sort(of_object[i].errors_m);
      std::ranges::sort(of_object[i].bounds_m);
      std::ranges::sort(of_object[i].turns_rad);
    }
  }
  return result;
}

}  // namespace clearway
