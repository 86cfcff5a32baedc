#include "clearway/report/box_residue.h"

#include <algorithm>
#include <array>

#include "absl/container/flat_hash_set.h"
#include "report/box_limit.h"

namespace clearway {
namespace {

Aabb BoxB(const TrueBox& box) { return {-0.5 * box.size_m, 0.5 * box.size_m}; }

bool Holds(const TrueBox& box, const Eigen::Vector3d& p_W, double padding_m) {
  return BoxB(box).Padded(padding_m).Contains(Inverse(box.T_W_B) * p_W);
}

// Without what is near its faces; may be empty.
Aabb MiddleOf(const TrueBox& box, double voxel_m) {
  const Eigen::Vector3d margin_m = Eigen::Vector3d::Constant(voxel_m);
  Aabb middle_B{-0.5 * box.size_m + margin_m, 0.5 * box.size_m - margin_m};
  middle_B.min.z() = -0.5 * box.size_m.z() + std::max(voxel_m, BoxResidueScore::kGround_m);
  return middle_B;
}

}  // namespace

void BoxResidueScore::Add(Time stamp) {
  for (const TrueBox& box : truth_.boxes(stamp)) {
    if (box.size_m.isZero()) continue;
    boxes_.push_back(box);
    last_[box.id] = box;
  }
}

BoxResidue BoxResidueScore::Of(const VoxelMap& map_W) const {
  const VoxelGrid& grid = map_W.grid();
  const double voxel_m = grid.resolution_m();
  absl::flat_hash_set<VoxelKey> passed;
  for (const TrueBox& box : boxes_) {
    const Aabb middle_B = MiddleOf(box, voxel_m);
    if ((middle_B.min.array() > middle_B.max.array()).any()) continue;
    const Aabb box_W = Transformed(box.T_W_B, middle_B);
    if (!CanLookThrough(grid, box_W)) continue;
    const Pose T_B_W = Inverse(box.T_W_B);
    const VoxelKey min = grid.KeyOf(box_W.min), max = grid.KeyOf(box_W.max);
    for (VoxelKey key = min; key.z <= max.z; ++key.z) {
      for (key.y = min.y; key.y <= max.y; ++key.y) {
        for (key.x = min.x; key.x <= max.x; ++key.x) {
          if (middle_B.Contains(T_B_W * grid.CenterOf(key))) passed.insert(key);
        }
      }
    }
  }
  BoxResidue residue;
  for (const VoxelKey& key : passed) {
    const bool may_stand = std::ranges::any_of(
        last_, [&](const auto& last) { return Holds(last.second, grid.CenterOf(key), voxel_m); });
    if (may_stand) continue;
    ++residue.passed;
    residue.occupied += map_W.State(key) == VoxelState::kOccupied;
  }
  return residue;
}

}  // namespace clearway
