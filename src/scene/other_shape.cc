#include "scene/other_shape.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
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

// What voxels of the object share, in one plane across an axis of O.
struct Layer {
  std::size_t voxels = 0;
  std::size_t passed = 0;  // by rays
  std::size_t there = 0;   // where the other one is
};

// By the axis of O, and by the voxels' key along it.
using Layers = std::array<std::map<std::int32_t, Layer>, 3>;

void Count(VoxelKey key, std::size_t Layer::*what, Layers& layers) {
  ++(layers[0][key.x].*what);
  ++(layers[1][key.y].*what);
  ++(layers[2][key.z].*what);
}

constexpr std::size_t kFewestVoxels = 6;  // fewer are strays

bool IsPassed(const Layer& layer) {
  return layer.passed >= kFewestVoxels && 2 * layer.passed >= layer.voxels;
}

// As one between two rows of beams is: rays tell of hardly any of its voxels.
bool IsUnseen(const Layer& layer) {
  constexpr std::size_t kOneTold = 10;  // of that many
  return kOneTold * (layer.passed + layer.there) < layer.voxels;
}

// Whether rays passed the object's outermost layers, from that end on up to where the other one is.
// One layer is off by rounding: it takes two that they passed, or one if three are missing and the
// others were not seen.
template <typename Iterator>
bool IsEndPassed(Iterator layer, Iterator end) {
  constexpr std::size_t kFewestPassed = 2;
  constexpr int kFewestMissing = 3;
  while (layer != end && layer->second.voxels < kFewestVoxels) ++layer;
  if (layer == end) return false;
  const std::int32_t outermost = layer->first;
  std::size_t passed = 0;
  for (; layer != end && (IsPassed(layer->second) || IsUnseen(layer->second)); ++layer) {
    passed += IsPassed(layer->second);
  }
  if (passed >= kFewestPassed) return true;
  return passed > 0 && layer != end && std::abs(layer->first - outermost) >= kFewestMissing;
}

}  // namespace

double ShareSeenThrough(const MovingObject& object, const MovingObject& other, const Pose& T_P_O,
                        const VoxelMap& around_P) {
  const Sight sight(object, other, T_P_O, around_P);
  std::size_t passed = 0, there = 0;
  Layers layers;
  object.map_O.blocks().ForEach([&](BlockKey block_key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const VoxelKey key = VoxelAt(block_key, index);
      Count(key, &Layer::voxels, layers);
      if (sight.IsThere(key)) {
        ++there;
        Count(key, &Layer::there, layers);
      } else if (sight.IsFree(key)) {
        Count(key, &Layer::passed, layers);
        passed += sight.IsPassed(key);
      }
    });
  });
  const bool end_is_passed = std::ranges::any_of(layers, [](const auto& of_axis) {
    return IsEndPassed(of_axis.begin(), of_axis.end()) ||
           IsEndPassed(of_axis.rbegin(), of_axis.rend());
  });
  if (end_is_passed) return 1;
  return passed == 0 ? 0 : static_cast<double>(passed) / static_cast<double>(passed + there);
}

}  // namespace clearway
