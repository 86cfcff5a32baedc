#include "scene/second_look.h"

#include <algorithm>
#include <optional>

namespace clearway {
namespace {

// None if it is not known where the object was.
std::optional<Pose> PoseAt(const MovingObject& object, Time stamp, bool between_poses) {
  const auto entry = std::ranges::lower_bound(object.history, stamp, {}, &StampedPose::stamp);
  if (entry == object.history.end()) return std::nullopt;
  if (entry->stamp == stamp) return entry->T_W_O;
  if (!between_poses || entry == object.history.begin()) return std::nullopt;
  return PredictPose(object, stamp, Duration::zero()).T_W_O;
}

// Whether the object fills the point's voxel, or one that is half a voxel from it along each axis.
bool FillsNear(const MovingObject& object, const Eigen::Vector3d& p_O) {
  const VoxelGrid& grid = object.map_O.grid();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const VoxelKey voxel = grid.KeyOf(p_O + 0.5 * grid.resolution_m() * signs);
    if (object.map_O.State(voxel) == VoxelState::kOccupied) return true;
  }
  return false;
}

void ForgetIfHitOnce(VoxelKey voxel, VoxelMap& map) {
  const VoxelBlock* before = map.blocks().Find(BlockOf(voxel));
  const int at = IndexInBlock(voxel);
  if (before == nullptr || !before->occupied.Test(at)) return;
  if (before->log_odds[at] > map.model().AfterHit(0)) return;
  VoxelBlock block = *before;
  block.Forget(at);
  map.PutBlock(BlockOf(voxel), block);
}

}  // namespace

void ForgetFilled(std::span<const Eigen::Vector3f> believed_W, Time stamp, const ObjectMap& objects,
                  VoxelMap& static_map_W, bool between_poses) {
  if (believed_W.empty()) return;
  for (const auto& [id, object] : objects) {
    const std::optional<Pose> T_W_O = PoseAt(*object, stamp, between_poses);
    if (!T_W_O) continue;
    const Aabb box_W = Transformed(*T_W_O, object->observed_box_O);
    const Pose T_O_W = Inverse(*T_W_O);
    for (const Eigen::Vector3f& point_W : believed_W) {
      const Eigen::Vector3d p_W = point_W.cast<double>();
      if (!box_W.Contains(p_W) || !FillsNear(*object, T_O_W * p_W)) continue;
      ForgetIfHitOnce(static_map_W.grid().KeyOf(p_W), static_map_W);
    }
  }
}

}  // namespace clearway
