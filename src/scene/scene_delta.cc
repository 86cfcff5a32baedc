#include "clearway/scene/scene_delta.h"

#include <algorithm>
#include <cstring>
#include <map>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr VoxelBlock kEmptyBlock{};

// The voxels with other log-odds, as bits.
BlockMask OtherLogOdds(const VoxelBlock& before, const VoxelBlock& after) {
  BlockMask other;
  for (int z = 0; z < 8; ++z) {
    const LogOdds* a = before.log_odds.data() + 64 * z;
    const LogOdds* b = after.log_odds.data() + 64 * z;
    if (std::memcmp(a, b, 64 * sizeof(LogOdds)) == 0) continue;
    for (int i = 0; i < 64; ++i) other.words[z] |= std::uint64_t{a[i] != b[i]} << i;
  }
  return other;
}

// The voxels that differ. A voxel that was never observed has log-odds 0 and is not occupied.
BlockMask Changed(const VoxelBlock& before, const VoxelBlock& after, MapDetail detail) {
  BlockMask changed;
  if (detail == MapDetail::kLogOdds) changed = OtherLogOdds(before, after);
  for (int z = 0; z < 8; ++z) {
    changed.words[z] |= before.observed.words[z] ^ after.observed.words[z];
    changed.words[z] |= before.occupied.words[z] ^ after.occupied.words[z];
  }
  return changed;
}

// What stands for an observed voxel in a delta.
LogOdds ValueOf(const VoxelBlock& block, int index, const OccupancyModel& model, MapDetail detail) {
  if (detail == MapDetail::kLogOdds) return block.log_odds[index];
  return block.occupied.Test(index) ? model.clamp_max : model.clamp_min;
}

MapDelta DiffMaps(const VoxelMap& from, const VoxelMap& to, MapDetail detail) {
  MapDelta delta;
  const auto add = [&](BlockKey key, const VoxelBlock* before, const VoxelBlock* after) {
    if (before == nullptr) before = &kEmptyBlock;
    if (after == nullptr) after = &kEmptyBlock;
    const BlockMask changed = Changed(*before, *after, detail);
    if (!changed.Any()) return;
    BlockDelta& block = delta.emplace_back(BlockDelta{key, changed, changed, {}});
    for (int z = 0; z < 8; ++z) block.observed.words[z] &= after->observed.words[z];
    block.log_odds.reserve(block.observed.Count());
    block.observed.ForEach(
        [&](int index) { block.log_odds.push_back(ValueOf(*after, index, to.model(), detail)); });
  };
  BlockTree::ForEachDifference(from.blocks(), to.blocks(), add);
  return delta;
}

ObjectDelta DiffObjects(const MovingObject* from, const MovingObject& to, MapDetail detail) {
  const VoxelMap empty(to.map_O.grid().resolution_m(), to.map_O.model());
  ObjectDelta delta;
  delta.id = to.id;
  delta.map_O = DiffMaps(from == nullptr ? empty : from->map_O, to.map_O, detail);
  delta.history = to.history;
  delta.velocity_O = to.velocity_O;
  delta.T_B_O = to.T_B_O;
  delta.first_seen = to.first_seen;
  delta.last_seen = to.last_seen;
  delta.frames_seen = to.frames_seen;
  delta.bridged = to.bridged;
  return delta;
}

absl::Status Malformed(const std::string& what) { return absl::InvalidArgumentError(what); }

absl::Status ApplyMap(const std::string& field, const MapDelta& delta, VoxelMap& map) {
  for (std::size_t i = 0; i < delta.size(); ++i) {
    const BlockDelta& change = delta[i];
    BlockMask outside = change.observed;
    outside.Subtract(change.changed);
    if (!InRange(VoxelAt(change.key, 0))) {
      return Malformed(absl::StrCat(field, ".blocks[", i, "]: address out of range"));
    }
    if (outside.Any() ||
        change.log_odds.size() != static_cast<std::size_t>(change.observed.Count())) {
      return Malformed(absl::StrCat(field, ".blocks[", i, "]: masks and values disagree"));
    }
    const VoxelBlock* before = map.blocks().Find(change.key);
    VoxelBlock block = before == nullptr ? kEmptyBlock : *before;
    auto value = change.log_odds.begin();
    change.changed.ForEach([&](int index) {
      change.observed.Test(index) ? block.Set(index, *value++, map.model()) : block.Forget(index);
    });
    map.PutBlock(change.key, block);
  }
  return absl::OkStatus();
}

absl::Status CheckHistory(const std::string& field, const std::vector<StampedPose>& history) {
  if (history.empty()) return Malformed(absl::StrCat(field, ".history: is empty"));
  for (std::size_t i = 0; i < history.size(); ++i) {
    const std::string entry = absl::StrCat(field, ".history[", i, "]");
    if (i > 0 && history[i].stamp <= history[i - 1].stamp) {
      return Malformed(absl::StrCat(entry, ".stamp_ns: does not ascend"));
    }
    constexpr double kAnyCoordinate_m = 1e9;
    if (auto status = ValidatePose(entry, history[i].T_W_O, kAnyCoordinate_m); !status.ok()) {
      return status;
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<const MovingObject>> ApplyObject(const MovingObject* base,
                                                                const ObjectDelta& delta,
                                                                const SceneParams& params) {
  const std::string field = absl::StrCat("objects[id=", delta.id, "]");
  if (delta.id <= kStaticLabel) return Malformed(absl::StrCat(field, ": object ids start at 1"));
  if (auto status = CheckHistory(field, delta.history); !status.ok()) return status;
  MovingObject object;
  if (base != nullptr) object = *base;
  object.id = delta.id;
  object.history = delta.history;
  object.velocity_O = delta.velocity_O;
  object.T_B_O = delta.T_B_O;
  object.first_seen = delta.first_seen;
  object.last_seen = delta.last_seen;
  object.frames_seen = delta.frames_seen;
  object.bridged = delta.bridged;
  if (base == nullptr || !delta.map_O.empty()) {
    VoxelMap map_O =
        base != nullptr ? base->map_O : VoxelMap(params.object_resolution_m, params.Model());
    if (auto status = ApplyMap(absl::StrCat(field, ".map"), delta.map_O, map_O); !status.ok()) {
      return status;
    }
    object = WithMap(std::move(object), std::move(map_O));
  }
  return std::make_shared<const MovingObject>(std::move(object));
}

}  // namespace

SceneDelta Diff(const SceneSnapshot* from, const SceneSnapshot& to, MapDetail detail) {
  const SceneSnapshot empty = SceneSnapshot::Empty(to.params);
  const SceneSnapshot& base = from == nullptr ? empty : *from;
  SceneDelta delta;
  delta.from_version = base.version;
  delta.to_version = to.version;
  delta.stamp = to.stamp;
  if (from == nullptr || !(from->params == to.params)) delta.params = to.params;
  delta.static_map_W = DiffMaps(base.static_map_W, to.static_map_W, detail);
  for (const auto& object : to.objects) {
    const MovingObject* before = base.FindObject(object->id);
    if (before != object.get()) delta.objects.push_back(DiffObjects(before, *object, detail));
  }
  for (const auto& object : base.objects) {
    if (to.FindObject(object->id) == nullptr) delta.removed.push_back(object->id);
  }
  return delta;
}

absl::StatusOr<SceneSnapshot> Apply(const SceneSnapshot* base, const SceneDelta& delta) {
  const std::uint64_t version = base == nullptr ? 0 : base->version;
  if (delta.from_version != version) {
    return absl::FailedPreconditionError(absl::StrCat("from_version: is ", delta.from_version,
                                                      "; the scene at hand is version ", version));
  }
  if (delta.params) {
    if (auto status = Validate(*delta.params); !status.ok()) return status;
  } else if (base == nullptr) {
    return Malformed("params: are missing from a delta that starts from nothing");
  }
  SceneSnapshot scene = base == nullptr ? SceneSnapshot::Empty(*delta.params) : *base;
  if (delta.params) scene.params = *delta.params;
  if (scene.static_map_W.grid().resolution_m() != scene.params.resolution_m ||
      !(scene.static_map_W.model() == scene.params.Model())) {
    return Malformed("params: resolution and occupancy model cannot change within a scene");
  }
  scene.version = delta.to_version;
  scene.stamp = delta.stamp;
  if (auto s = ApplyMap("static_map", delta.static_map_W, scene.static_map_W); !s.ok()) return s;

  std::map<ObjectId, std::shared_ptr<const MovingObject>> objects;
  for (const auto& object : scene.objects) objects[object->id] = object;
  for (ObjectId id : delta.removed) objects.erase(id);
  for (const ObjectDelta& change : delta.objects) {
    const auto known = objects.find(change.id);
    auto object =
        ApplyObject(known == objects.end() ? nullptr : known->second.get(), change, scene.params);
    if (!object.ok()) return object.status();
    objects[change.id] = *std::move(object);
  }
  scene.objects.clear();
  for (auto& [id, object] : objects) scene.objects.push_back(std::move(object));
  return scene;
}

}  // namespace clearway
