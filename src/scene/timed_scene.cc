#include "clearway/scene/timed_scene.h"

namespace clearway {

TimedScene::TimedScene(const SceneSnapshot& scene, Time first, Time last)
    : scene_(scene), index_(scene, first, last) {}

const SceneAtTime::Placed& TimedScene::Placed(std::size_t object, Time time) {
  constexpr std::size_t kMost = 1 << 14;  // a few MB
  if (placed_.size() >= kMost) placed_.clear();
  const auto [entry, fresh] = placed_.try_emplace({object, ToNanoseconds(time)});
  if (fresh) entry->second = SceneAtTime::Place(scene_, *scene_.objects[object], time);
  return entry->second;
}

PointOccupancy TimedScene::At(const Eigen::Vector3d& p_W, Time time) {
  PointOccupancy answer = StaticOccupancy(scene_, p_W);
  if (answer.status == SpaceStatus::kOutOfBounds) return answer;
  index_.ForEachNear({p_W, p_W}, [&](std::size_t object) {
    AddObject(scene_, Placed(object, time), p_W, answer);
  });
  return answer;
}

}  // namespace clearway
