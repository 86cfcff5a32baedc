#include "server/timed_scene.h"

namespace clearway {
namespace {

constexpr std::size_t kMostTimes = 256;  // that are kept; each holds a few hundred bytes per object
constexpr double kRounding_m = 1e-6;

double FarthestCorner_m(const Aabb& box_O) {
  if (box_O.Empty()) return 0;
  return box_O.min.cwiseAbs().cwiseMax(box_O.max.cwiseAbs()).norm();
}

SceneSnapshot WithoutObjects(const SceneSnapshot& scene) {
  SceneSnapshot bare = SceneSnapshot::Empty(scene.params);
  bare.static_map_W = scene.static_map_W;
  return bare;
}

}  // namespace

TimedScene::TimedScene(const SceneSnapshot& scene)
    : scene_(scene),
      without_objects_(WithoutObjects(scene)),
      static_map_(without_objects_, scene.stamp) {
  for (const auto& object : scene.objects) reaches_.push_back(ReachOf(*object));
}

TimedScene::Reach TimedScene::ReachOf(const MovingObject& object) {
  const double radius_m = std::max({FarthestCorner_m(object.observed_box_O),
                                    FarthestCorner_m(object.solid->box_O), object.solid->radius_m});
  return {object.history.back().T_W_O.translation, radius_m + kRounding_m, object.SpeedMps(),
          object.t_k()};
}

bool TimedScene::MayMeetAnObject(const Eigen::Vector3d& p_W, Time time) const {
  for (const Reach& reach : reaches_) {
    if (time < reach.t_k) return true;  // the history may have been anywhere
    const double reach_m = reach.radius_m + reach.speed_mps * ToSeconds(time - reach.t_k);
    if ((p_W - reach.center_W).squaredNorm() <= reach_m * reach_m) return true;
  }
  return false;
}

const SceneAtTime& TimedScene::Placed(Time time) {
  if (placed_.size() >= kMostTimes) placed_.clear();
  return placed_.try_emplace(ToNanoseconds(time), scene_, time).first->second;
}

PointOccupancy TimedScene::At(const Eigen::Vector3d& p_W, Time time) {
  return MayMeetAnObject(p_W, time) ? Placed(time).At(p_W) : static_map_.At(p_W);
}

}  // namespace clearway
