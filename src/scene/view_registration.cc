#include "scene/view_registration.h"

#include <algorithm>
#include <vector>

namespace clearway {
namespace {

constexpr RegistrationWeights kWeights = {.trust = 0.2, .least_step = 5e-3};
constexpr std::size_t kMostPoints = 128;

std::vector<Eigen::Vector3d> AFew(std::span<const Eigen::Vector3d> points_W) {
  const std::size_t step = std::max<std::size_t>(1, (points_W.size() - 1) / kMostPoints + 1);
  std::vector<Eigen::Vector3d> few;
  for (std::size_t i = 0; i < points_W.size(); i += step) few.push_back(points_W[i]);
  return few;
}

}  // namespace

Pose RegisterView(const VoxelMap& map_O, std::span<const Eigen::Vector3d> points_W,
                  std::span<const PoseGuess> guesses) {
  BlockMoments moments(map_O);
  SurfaceCells coarse(moments, SurfaceCells::Size::kBlock, Eigen::Vector3d::Zero());
  SurfaceCells fine(moments, SurfaceCells::Size::kOctant, Eigen::Vector3d::Zero());
  const RegistrationStage stages[] = {{coarse, 3, 6}, {coarse, 1.5, 4}, {fine, 2, 8}};
  const std::vector<Eigen::Vector3d> few_W = AFew(points_W);
  return Registration(few_W, guesses, kWeights).Register(stages);
}

}  // namespace clearway
