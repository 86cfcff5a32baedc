#include "clearway/scene/scene_delta.h"

#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "scene/map_delta.h"
#include "scene/object_delta.h"

namespace clearway {
namespace {

absl::Status Malformed(const std::string& what) { return absl::InvalidArgumentError(what); }

absl::Status CheckDynamic(const SceneSnapshot& scene) {
  const auto voxels = scene.dynamic_W.voxels();
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const auto& [key, first_hit, last_hit] = voxels[i];
    const std::string field = absl::StrCat("dynamic[", i, "]");
    if (!InRange(key)) return Malformed(field + ": address out of range");
    if (i > 0 && !ComesBefore(voxels[i - 1].key, key)) return Malformed(field + ": out of order");
    if (first_hit > last_hit) return Malformed(field + ": was last hit before it first was");
    if (scene.static_map_W.State(key) != VoxelState::kOccupied) {
      return Malformed(field + ": is not occupied");
    }
  }
  return absl::OkStatus();
}

// Not under another of its ids: null then.
const MovingObject* ObjectUnder(ObjectId first_id, const SceneSnapshot& scene) {
  const MovingObject* object = scene.FindObject(first_id);
  return object != nullptr && object->id == first_id ? object : nullptr;
}

}  // namespace

SceneDifference::SceneDifference(const SceneSnapshot* from, const SceneSnapshot& to,
                                 MapDetail detail)
    : empty_(SceneSnapshot::Empty(to.params)),
      from_(from == nullptr ? empty_ : *from),
      to_(to),
      detail_(detail) {}

SceneDelta SceneDifference::Head() const {
  SceneDelta head;
  head.from_version = from_.version;
  head.to_version = to_.version;
  head.stamp = to_.stamp;
  if (&from_ == &empty_ || !(from_.params == to_.params)) head.params = to_.params;
  if (!(from_.dynamic_W == to_.dynamic_W)) head.dynamic_W = to_.dynamic_W;
  for (const auto& object : from_.objects) {
    if (ObjectUnder(object->id, to_) == nullptr) head.removed.push_back(object->id);
  }
  return head;
}

bool SceneDifference::ForEachBlock(const std::function<bool(BlockDelta)>& take) const {
  return DiffMaps(from_.static_map_W, to_.static_map_W, detail_, take);
}

bool SceneDifference::ForEachObject(const std::function<bool(ObjectDelta)>& take) const {
  for (const auto& object : to_.objects) {
    const MovingObject* before = ObjectUnder(object->id, from_);
    if (before != object.get() && !take(DiffObjects(before, *object, detail_))) return false;
  }
  return true;
}

SceneDelta Diff(const SceneSnapshot* from, const SceneSnapshot& to, MapDetail detail) {
  const SceneDifference difference(from, to, detail);
  SceneDelta delta = difference.Head();
  difference.ForEachBlock([&](BlockDelta block) {
    delta.static_map_W.push_back(std::move(block));
    return true;
  });
  difference.ForEachObject([&](ObjectDelta object) {
    delta.objects.push_back(std::move(object));
    return true;
  });
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
  if (delta.dynamic_W) scene.dynamic_W = *delta.dynamic_W;
  if (auto s = CheckDynamic(scene); !s.ok()) return s;

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
