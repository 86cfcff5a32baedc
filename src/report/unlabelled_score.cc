#include "clearway/report/unlabelled_score.h"

#include <algorithm>
#include <vector>

namespace clearway {
namespace {

// Where the movers are, to within a voxel.
class Places {
 public:
  Places(const Truth& truth, const std::set<ObjectId>& movers, Time t, double voxel_m) {
    for (const TrueBox& box : truth.boxes(t)) {
      if (!movers.contains(box.id)) continue;
      const Eigen::Vector3d half_m = 0.5 * box.size_m;
      boxes_.push_back({Inverse(box.T_W_B), Aabb{-half_m, half_m}.Padded(voxel_m)});
    }
  }

  bool Hold(const Eigen::Vector3d& p_W) const {
    return std::ranges::any_of(
        boxes_, [&](const Placed& placed) { return placed.box_B.Contains(placed.T_B_W * p_W); });
  }

 private:
  struct Placed {
    Pose T_B_W;
    Aabb box_B;
  };
  std::vector<Placed> boxes_;
};

}  // namespace

void UnlabelledScore::AddPoints(const Frame& frame, const SceneSnapshot& scene) {
  const VoxelMap& map = scene.static_map_W;
  const double range_m = scene.params.rays.max_range_m;
  for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
    const Eigen::Vector3d p_S = frame.points_S[i].cast<double>();
    const bool returned = frame.no_return.empty() || frame.no_return[i] == 0;
    if (!returned || !p_S.allFinite() || (range_m >= 0 && p_S.norm() > range_m)) continue;
    const VoxelKey key = map.grid().KeyOf(frame.T_W_S * p_S);
    if (frame.labels[i] == kStaticLabel) of_static_.insert(key);
    if (!movers_.contains(frame.labels[i])) continue;
    of_movers_.insert(key);
    ++counts_.points;
    counts_.points_occupied += map.State(key) == VoxelState::kOccupied;
  }
}

void UnlabelledScore::CountLeft(const Frame& frame, const SceneSnapshot& scene) {
  const VoxelMap& map = scene.static_map_W;
  const Places now(truth_, movers_, frame.stamp, map.grid().resolution_m());
  counts_.last_trail = 0;
  for (const VoxelKey key : of_movers_) {
    if (map.State(key) != VoxelState::kOccupied || of_static_.contains(key) ||
        now.Hold(map.grid().CenterOf(key))) {
      continue;
    }
    ++(scene.dynamic_W.Find(key) == nullptr ? counts_.last_trail : counts_.dynamic_left);
  }
  counts_.trail += counts_.last_trail;
  counts_.most_trail = std::max(counts_.most_trail, counts_.last_trail);
  for (const DynamicVoxel& voxel : scene.dynamic_W.voxels()) {
    ++counts_.dynamic;
    counts_.dynamic_elsewhere +=
        !of_movers_.contains(voxel.key) && !now.Hold(map.grid().CenterOf(voxel.key));
  }
}

void UnlabelledScore::Add(const Frame& frame, const SceneSnapshot& scene) {
  ++counts_.frames;
  AddPoints(frame, scene);
  CountLeft(frame, scene);
}

}  // namespace clearway
