#include "clearway/report/prediction_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clearway {

double PredictionErrors::Quantile(double share) const {
  if (errors_m.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto last = static_cast<double>(errors_m.size() - 1);
  return errors_m[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * last))];
}

PredictionScore::PredictionScore(Truth truth, std::vector<Duration> ahead)
    : truth_(std::move(truth)), ahead_(std::move(ahead)) {}

void PredictionScore::Add(const SceneSnapshot& scene) {
  for (const auto& object : scene.objects) {
    if (object->t_k() != scene.stamp || object->bridged) continue;
    const auto now = BoxOf(truth_, object->id, scene.stamp);
    if (!now) continue;
    auto& errors_m = errors_m_.try_emplace(object->id, ahead_.size()).first->second;
    const Pose T_O_W = Inverse(object->history.back().T_W_O);
    for (std::size_t i = 0; i < ahead_.size(); ++i) {
      const Time then = scene.stamp + ahead_[i];
      const auto box = then > truth_.end ? std::nullopt : BoxOf(truth_, object->id, then);
      if (!box) continue;
      const Pose T_W_O = PredictPose(*object, then, scene.params.horizon).T_W_O;
      const Eigen::Vector3d predicted_W = T_W_O * (T_O_W * now->T_W_B.translation);
      errors_m[i].push_back((predicted_W - box->T_W_B.translation).norm());
    }
  }
}

std::map<ObjectId, std::vector<PredictionErrors>> PredictionScore::Errors() const {
  std::map<ObjectId, std::vector<PredictionErrors>> result;
  for (const auto& [id, of_object] : errors_m_) {
    for (std::size_t i = 0; i < ahead_.size(); ++i) {
      PredictionErrors& errors = result[id].emplace_back(PredictionErrors{ahead_[i], of_object[i]});
      std::ranges::sort(errors.errors_m);
    }
  }
  return result;
}

}  // namespace clearway
