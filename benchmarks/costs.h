// What single steps cost, measured once, with one thread.
#pragma once

#include <chrono>
#include <vector>

#include "clearway/scene/frame.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway::bench {

// The time that work() takes, in `Unit`, a period as of std::chrono.
template <class Unit, class Work>
double Took(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, Unit>(std::chrono::steady_clock::now() - begin).count();
}

// A scan applied and published while a reader holds the version before: ms a scan. The first scan
// is left out.
double IntegrateMs(const std::vector<Frame>& frames, const SceneParams& params);

// Random points in the box, each at one of 64 times: ns a point.
double LookupNs(const SceneSnapshot& scene, const Aabb& box_W);

// A box of 4 x 1.8 x 1.5 m at random poses with its centre in the box, unknown space free: ns a
// state.
double CheckNs(const ScenePtr& scene, const Aabb& box_W);

// The scene that the frames make.
ScenePtr SceneOf(const std::vector<Frame>& frames, const SceneParams& params);

}  // namespace clearway::bench
