#include "clearway/scene/dynamic_space.h"

#include <algorithm>

namespace clearway {

DynamicSpace::DynamicSpace(std::vector<DynamicVoxel> voxels) {
  if (voxels.empty()) return;
  voxels_ = std::make_shared<const std::vector<DynamicVoxel>>(std::move(voxels));
}

std::span<const DynamicVoxel> DynamicSpace::voxels() const {
  return voxels_ == nullptr ? std::span<const DynamicVoxel>() : std::span(*voxels_);
}

const DynamicVoxel* DynamicSpace::Find(VoxelKey key) const {
  const std::span<const DynamicVoxel> all = voxels();
  const auto found =
      std::ranges::lower_bound(all, key, ComesBefore, [](const DynamicVoxel& v) { return v.key; });
  return found != all.end() && found->key == key ? &*found : nullptr;
}

bool DynamicSpace::operator==(const DynamicSpace& other) const {
  return voxels_ == other.voxels_ || std::ranges::equal(voxels(), other.voxels());
}

}  // namespace clearway
