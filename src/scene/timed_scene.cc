#include "clearway/scene/timed_scene.h"

#include "scene/query_ray.h"

namespace clearway {

TimedScene::TimedScene(const SceneSnapshot& scene, Time first, Time last)
    : scene_(scene), index_(scene, first, last), static_map_(scene.static_map_W) {}

const SceneAtTime::Placed& TimedScene::Placed(std::size_t object, Time time) {
  constexpr std::size_t kMost = 1 << 14;  // a few MB
  if (placed_.size() >= kMost) placed_.clear();
  const auto [entry, fresh] = placed_.try_emplace({object, ToNanoseconds(time)});
  if (fresh) entry->second = SceneAtTime::Place(scene_, *scene_.objects[object], time);
  return entry->second;
}

void TimedScene::AddObjects(const Eigen::Vector3d& p_W, Time time, PointOccupancy& answer) {
  if (answer.status == SpaceStatus::kOutOfBounds) return;
  index_.ForEachNear({p_W, p_W}, time, [&](std::size_t object) {
    AddObject(scene_, Placed(object, time), p_W, answer);
  });
}

PointOccupancy TimedScene::At(const Eigen::Vector3d& p_W, Time time) {
  PointOccupancy answer;
  At({&p_W, 1}, {&time, 1}, {&answer, 1});
  return answer;
}

RayAnswer TimedScene::CastRay(const Eigen::Vector3d& origin_W, const Eigen::Vector3d& direction_W,
                              double max_range_m, Time time,
                              const std::function<bool()>& cancelled) {
  return QueryRay(scene_, origin_W, direction_W, max_range_m)
      .Cast([&](const Eigen::Vector3d& p_W) { return At(p_W, time); }, cancelled);
}

void TimedScene::At(std::span<const Eigen::Vector3d> points_W, std::span<const Time> times,
                    std::span<PointOccupancy> answers) {
  const VoxelGrid& grid = scene_.static_map_W.grid();
  addressable_W_.assign(points_W.begin(), points_W.end());
  for (Eigen::Vector3d& p_W : addressable_W_) {
    if (!grid.Addressable(p_W)) p_W.setZero();  // StaticOccupancy will see
  }
  static_map_.ForEach(addressable_W_, [&](std::size_t i, const VoxelBlock& block, int index) {
    const bool observed = block.observed.Test(index);
    answers[i] = StaticOccupancy(scene_, points_W[i],
                                 observed ? std::optional(block.log_odds[index]) : std::nullopt);
    AddObjects(points_W[i], times[i], answers[i]);
  });
}

}  // namespace clearway
