#include "server/delta_cache.h"

#include "wire/delta_wire.h"
#include "wire/scene_wire.h"

namespace clearway {

std::shared_ptr<DeltaCache::Slot> DeltaCache::SlotOf(const Key& key) {
  std::shared_ptr<Slot> dropped;  // freed after the lock
  std::lock_guard lock(mutex_);
  std::shared_ptr<Slot> slot = slots_[key].lock();
  if (slot != nullptr) return slot;
  std::erase_if(slots_, [](const auto& entry) { return entry.second.expired(); });
  slot = std::make_shared<Slot>();
  slots_[key] = slot;
  dropped = std::exchange(last_[std::get<MapDetail>(key)], slot);
  return slot;
}

std::shared_ptr<const DeltaCache::Messages> DeltaCache::Between(const SceneSnapshot* from,
                                                                const SceneSnapshot& to,
                                                                MapDetail detail) {
  const std::shared_ptr<Slot> slot =
      SlotOf({from == nullptr ? 0 : from->version, to.version, detail});
  std::call_once(slot->made, [&] {
    Messages messages;
    WriteDifference(SceneDifference(from, to, detail), [&](const v1::SceneDeltaPart& part) {
      *messages.emplace_back(AboutVersion(to, instance_)).mutable_delta() = part;
      return true;
    });
    slot->messages = std::move(messages);
  });
  return {slot, &slot->messages};
}

v1::FollowSceneResponse AboutVersion(const SceneSnapshot& scene, const std::string& instance) {
  v1::FollowSceneResponse response;
  Write(VersionOf(scene), response.mutable_scene());
  response.set_server_instance(instance);
  return response;
}

}  // namespace clearway
