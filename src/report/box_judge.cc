#include "clearway/report/box_judge.h"

#include <utility>

namespace clearway {

BoxJudge::BoxJudge(const Truth& truth, const std::map<ObjectId, Eigen::Vector3d>& sizes_m,
                   std::vector<Duration> ahead)
    : met_(TrueBodies(truth, sizes_m)),
      objects_(TrueBodies(truth, sizes_m)),
      solids_(TrueBodies(truth, sizes_m), truth.end, std::move(ahead)),
      residue_(truth) {}

void BoxJudge::Add(std::size_t k, const Frame& frame, const SceneSnapshot& scene) {
  constexpr std::size_t kSolidsEvery = 5;
  met_.Add(frame, frame.T_W_S, scene);
  objects_.Add(scene, Pose{});
  if (k % kSolidsEvery == 0) solids_.Add(scene, met_);
  residue_.Add(scene.stamp);
}

}  // namespace clearway
