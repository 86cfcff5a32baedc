#include "scene/other_shape.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#include "clearway/map/voxel_neighbours.h"

namespace clearway {
namespace {

// What was seen of the other one where the object's voxels would be, by their keys in O.
class Sight {
 public:
  Sight(const MovingObject& object, const MovingObject& other, const Pose& T_P_O,
        const VoxelMap& around_P)
      : map_O_(object.map_O),
        middle_(map_O_.grid().KeyOf(object.observed_box_O.Center())),
        map_P_(other.map_O),
        T_P_O_(T_P_O),
        around_P_(around_P) {}

  bool IsThere(VoxelKey key) const { return NearOccupied(map_P_, InP(key)); }
  bool IsFree(VoxelKey key) const {
    const Eigen::Vector3d p_P = InP(key);
    return around_P_.grid().Addressable(p_P) &&
           around_P_.State(around_P_.grid().KeyOf(p_P)) == VoxelState::kFree;
  }
  // With all of O that touches it, and with what lies further in: over a flat face rays may pass
  // within the very voxels that it lies in.
  bool IsPassed(VoxelKey key) const {
    return std::ranges::all_of(FurtherIn(key), [&](VoxelKey in) { return IsFree(in); }) &&
           std::ranges::all_of(WithNeighbours(key), [&](VoxelKey near) {
             return map_O_.State(near) != VoxelState::kOccupied || IsFree(near);
           });
  }

 private:
  Eigen::Vector3d InP(VoxelKey key) const { return T_P_O_ * map_O_.grid().CenterOf(key); }
  // Along each axis, the voxel next to it that is nearer to the middle.
  std::array<VoxelKey, 3> FurtherIn(VoxelKey key) const {
    const auto towards = [](int from, int to) { return from + (to > from) - (to < from); };
    return {VoxelKey{towards(key.x, middle_.x), key.y, key.z},
            VoxelKey{key.x, towards(key.y, middle_.y), key.z},
            VoxelKey{key.x, key.y, towards(key.z, middle_.z)}};
  }

  const VoxelMap& map_O_;
  VoxelKey middle_;
  const VoxelMap& map_P_;
  Pose T_P_O_;
  const VoxelMap& around_P_;
};

// By the axis of O, and by what keys of one plane across it share: how many of them there are.
using Layers = std::array<std::map<std::int32_t, std::size_t>, 3>;

void Count(VoxelKey key, Layers& layers) {
  ++layers[0][key.x];
  ++layers[1][key.y];
  ++layers[2][key.z];
}

// One layer is off by rounding, and a few voxels are strays.
constexpr std::size_t kFewestLayers = 2, kFewestVoxels = 6;

// Whether rays passed where half of the voxels would be of each of the object's outermost layers,
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

}  // namespace

double ShareSeenThrough(const MovingObject& object, const MovingObject& other, const Pose& T_P_O,
                        const VoxelMap& around_P) {
  const Sight sight(object, other, T_P_O, around_P);
  std::size_t passed = 0, there = 0;
  Layers of_object, free;
  object.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      Count(key, of_object);
      if (sight.IsThere(key)) {
        ++there;
      } else if (sight.IsFree(key)) {
        Count(key, free);
        passed += sight.IsPassed(key);
      }
    });
  });
  const bool end_is_passed = std::ranges::any_of(std::array{0, 1, 2}, [&](int axis) {
    const auto &known = of_object[axis], &passed_of = free[axis];
    return IsEndPassed(known.begin(), known.end(), passed_of) ||
           IsEndPassed(known.rbegin(), known.rend(), passed_of);
  });
  if (end_is_passed) return 1;
  return passed == 0 ? 0 : static_cast<double>(passed) / static_cast<double>(passed + there);
}

}  // namespace clearway
