#include "clearway/report/surface_judge.h"

#include <utility>

namespace clearway {

SurfaceJudge::SurfaceJudge(Simulation simulation, std::vector<Duration> ahead)
    : simulation_(std::move(simulation)),
      world_(std::make_shared<const World>(simulation_.world())),
      met_(world_),
      objects_(world_),
      solids_(world_, simulation_.StampOf(simulation_.frame_count() - 1), std::move(ahead)) {}

void SurfaceJudge::Add(std::size_t k, const Frame& frame, const SceneSnapshot& scene) {
  constexpr std::size_t kSolidsEvery = 5;
  const Pose T_W_S = simulation_.TrueT_W_S(k);
  met_.Add(frame, T_W_S, scene);
  objects_.Add(scene, frame.T_W_S * Inverse(T_W_S));
  if (added_++ % kSolidsEvery == 0) solids_.Add(scene, met_);
}

}  // namespace clearway
