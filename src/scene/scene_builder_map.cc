// Changes of the static map that do not come from frames. Each works on a copy, which shares its
// memory with the scene, so that one that fails, be it for lack of memory, changes nothing.
#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
#include "clearway/map/resolution.h"
#include "clearway/scene/scene_builder.h"
#include "scene/dynamic_hits.h"
#include "scene/scene_size.h"

namespace clearway {
namespace {

VoxelBlock WithPrior(VoxelBlock block, const VoxelBlock& prior, const OccupancyModel& model) {
  prior.observed.ForEach([&](int index) {
    block.Set(index, std::clamp(prior.log_odds[index], model.clamp_min, model.clamp_max), model);
  });
  return block;
}

}  // namespace

absl::Status SceneBuilder::LoadPrior(const VoxelMap& prior_W) {
  const double resolution_m = scene_.static_map_W.grid().resolution_m();
  if (!SameResolution(prior_W.grid().resolution_m(), resolution_m)) {
    return absl::InvalidArgumentError(
        absl::StrCat("map: has voxels of ", NumberText(prior_W.grid().resolution_m()),
                     " m; the scene has voxels of ", NumberText(resolution_m), " m"));
  }
  const std::size_t others = BlocksOf(scene_.objects, dropped_lately_, around_objects_);
  std::size_t blocks = scene_.static_map_W.blocks().size() + others;
  prior_W.blocks().ForEach([&](BlockKey key, const VoxelBlock&) {
    blocks += scene_.static_map_W.blocks().Find(key) == nullptr;
  });
  if (absl::Status status = CheckBlocks("map", blocks, limits_); !status.ok()) return status;

  VoxelMap static_map_W = scene_.static_map_W;
  prior_W.blocks().ForEach([&](BlockKey key, const VoxelBlock& prior) {
    const VoxelBlock* before = static_map_W.blocks().Find(key);
    static_map_W.PutBlock(
        key, WithPrior(before == nullptr ? VoxelBlock{} : *before, prior, static_map_W.model()));
  });
  DynamicSpace dynamic_W = WithoutObserved(scene_.dynamic_W, prior_W);
  scene_.static_map_W = std::move(static_map_W);
  scene_.dynamic_W = std::move(dynamic_W);
  believed_W_.clear();  // what the prior says there stays
  changed_ = true;
  return absl::OkStatus();
}

std::int64_t SceneBuilder::ClearRegion(const Aabb& box_W) {
  VoxelMap static_map_W = scene_.static_map_W;
  const std::int64_t cleared = static_map_W.Forget(box_W);
  DynamicSpace dynamic_W = StillIn(static_map_W, scene_.dynamic_W);
  scene_.static_map_W = std::move(static_map_W);
  scene_.dynamic_W = std::move(dynamic_W);
  changed_ = true;
  return cleared;
}

void SceneBuilder::SetKeepOut(std::vector<Aabb> boxes_W) {
  scene_.params.keep_out_W = std::move(boxes_W);
  changed_ = true;
}

}  // namespace clearway
