#include "scene/other_shape.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#include "clearway/map/voxel_neighbours.h"
#include "scene/occupied_centers.h"

namespace clearway {
namespace {

// What was seen of the young one where the lost one's voxels would be, by their keys in L.
class Sight {
 public:
  Sight(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
        const VoxelMap& around_Y)
      : map_L_(lost.map_O),
        middle_(map_L_.grid().KeyOf(lost.observed_box_O.Center())),
        map_Y_(young.map_O),
        T_Y_L_(T_Y_L),
        around_Y_(around_Y) {}

  bool IsThere(VoxelKey key) const { return NearOccupied(map_Y_, InY(key)); }
  bool IsFree(VoxelKey key) const {
    const Eigen::Vector3d p_Y = InY(key);
    return around_Y_.grid().Addressable(p_Y) &&
           around_Y_.State(around_Y_.grid().KeyOf(p_Y)) == VoxelState::kFree;
  }
  // With all of L that touches it, and with what lies further in: over a flat face rays may pass
  // within the very voxels that it lies in.
  bool IsPassed(VoxelKey key) const {
    return std::ranges::all_of(FurtherIn(key), [&](VoxelKey in) { return IsFree(in); }) &&
           std::ranges::all_of(WithNeighbours(key), [&](VoxelKey near) {
             return map_L_.State(near) != VoxelState::kOccupied || IsFree(near);
           });
  }

 private:
  Eigen::Vector3d InY(VoxelKey key) const { return T_Y_L_ * map_L_.grid().CenterOf(key); }
  // Along each axis, the voxel next to it that is nearer to the middle.
  std::array<VoxelKey, 3> FurtherIn(VoxelKey key) const {
    const auto towards = [](int from, int to) { return from + (to > from) - (to < from); };
    return {VoxelKey{towards(key.x, middle_.x), key.y, key.z},
            VoxelKey{key.x, towards(key.y, middle_.y), key.z},
            VoxelKey{key.x, key.y, towards(key.z, middle_.z)}};
  }

  const VoxelMap& map_L_;
  VoxelKey middle_;
  const VoxelMap& map_Y_;
  Pose T_Y_L_;
  const VoxelMap& around_Y_;
};

// By the axis of L, and by what keys of one plane across it share: how many of them there are.
using Layers = std::array<std::map<std::int32_t, std::size_t>, 3>;

void Count(VoxelKey key, Layers& layers) {
  ++layers[0][key.x];
  ++layers[1][key.y];
  ++layers[2][key.z];
}

// One layer is off by rounding, and a few voxels are strays.
constexpr std::size_t kFewestLayers = 2, kFewestVoxels = 6;

// Whether rays passed where half of the voxels would be of each of the lost one's outermost layers,
// from that end on.
template <typename Iterator>
bool IsEndPassed(Iterator layer, Iterator end, const std::map<std::int32_t, std::size_t>& passed) {
  const auto is_passed = [&](const auto& known) {
    const auto found = passed.find(known.first);
    const std::size_t count = found == passed.end() ? 0 : found->second;
    return count >= kFewestVoxels && 2 * count >= known.second;
  };
  while (layer != end && layer->second < kFewestVoxels) ++layer;
  std::size_t layers = 0;
  for (; layer != end && is_passed(*layer); ++layer) ++layers;
  return layers >= kFewestLayers;
}

// Whether layers of the young one lie beyond all of the lost one's, above, below, or along the
// longer of its x and y. Of its width, the far side is seldom seen.
bool IsLongerOrHigher(const Layers& lost, const Layers& young) {
  constexpr auto kBeyond = static_cast<std::int32_t>(kFewestLayers);
  const int along = lost[0].size() >= lost[1].size() ? 0 : 1;
  return std::ranges::any_of(std::array{along, 2}, [&](int axis) {
    if (lost[axis].empty()) return false;
    const std::int32_t first = lost[axis].begin()->first, last = lost[axis].rbegin()->first;
    return std::ranges::any_of(young[axis], [&](const auto& layer) {
      return layer.second >= kFewestVoxels &&
             (layer.first >= last + kBeyond || layer.first <= first - kBeyond);
    });
  });
}

// The young one's voxels by the keys in L that they lie in.
Layers LayersOfYoung(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L) {
  const Pose T_L_Y = Inverse(T_Y_L);
  Layers layers;
  for (const Eigen::Vector3d& p_Y : OccupiedCenters(young.map_O)) {
    const Eigen::Vector3d p_L = T_L_Y * p_Y;
    if (lost.map_O.grid().Addressable(p_L)) Count(lost.map_O.grid().KeyOf(p_L), layers);
  }
  return layers;
}

}  // namespace

bool HasOtherShape(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                   const VoxelMap& around_Y) {
  constexpr std::size_t kOneIn = 8;
  const Sight sight(lost, young, T_Y_L, around_Y);
  std::size_t passed = 0, there = 0;
  Layers of_lost, free;
  lost.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      Count(key, of_lost);
      if (sight.IsThere(key)) {
        ++there;
      } else if (sight.IsFree(key)) {
        Count(key, free);
        passed += sight.IsPassed(key);
      }
    });
  });
  if (kOneIn * passed > passed + there) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const auto &known = of_lost[axis], &passed_of = free[axis];
    if (IsEndPassed(known.begin(), known.end(), passed_of) ||
        IsEndPassed(known.rbegin(), known.rend(), passed_of)) {
      return true;
    }
  }
  return IsLongerOrHigher(of_lost, LayersOfYoung(lost, young, T_Y_L));
}

}  // namespace clearway
