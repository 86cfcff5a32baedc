#include "costs.h"

#include <cstdlib>

#include "clearway/collision/scene_checker.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/scene/timed_scene.h"
#include "drive_map.h"

namespace clearway::bench {

double IntegrateMs(const std::vector<Frame>& frames, const SceneParams& params) {
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  double sum_ms = 0;
  ScenePtr held;
  for (const Frame& frame : frames) {
    const double ms = Took<std::milli>([&] {
      if (!builder.Apply(frame).ok()) std::abort();
      held = builder.Publish();
    });
    if (&frame != &frames.front()) sum_ms += ms;
  }
  return sum_ms / static_cast<double>(frames.size() - 1);
}

double LookupNs(const SceneSnapshot& scene, const Aabb& box_W) {
  constexpr std::size_t kPoints = 100'000;
  Dice dice;
  std::vector<Eigen::Vector3d> points_W;
  std::vector<Time> times;
  for (std::size_t i = 0; i < kPoints; ++i) {
    points_W.push_back(dice.PointIn(box_W));
    times.push_back(scene.stamp + std::chrono::milliseconds(i % 64 * 78));
  }
  std::vector<PointOccupancy> answers(kPoints);
  return Took<std::nano>([&] {
           TimedScene timed(scene, scene.stamp, scene.stamp + FromSeconds(5));
           timed.At(points_W, times, answers);
         }) /
         kPoints;
}

double CheckNs(const ScenePtr& scene, const Aabb& box_W) {
  constexpr std::size_t kStates = 5'000;
  const SceneChecker checker(scene, Robot::SingleShape("box", Box{Eigen::Vector3d(4, 1.8, 1.5)}));
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  Dice dice;
  StateBatch states;
  for (std::size_t i = 0; i < kStates; ++i) {
    states.T_W_L.push_back({dice.Rotation(), dice.PointIn(box_W)});
    states.times.push_back(scene->stamp + std::chrono::milliseconds(i % 64 * 78));
  }
  return Took<std::nano>([&] {
           if (!checker.Check(states, options).ok()) std::abort();
         }) /
         kStates;
}

ScenePtr SceneOf(const std::vector<Frame>& frames, const SceneParams& params) {
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  for (const Frame& frame : frames) {
    if (!builder.Apply(frame).ok()) std::abort();
  }
  return builder.Publish();
}

}  // namespace clearway::bench
