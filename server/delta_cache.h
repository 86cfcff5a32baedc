// The differences that mirrors are sent.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "clearway/scene/scene_delta.h"
#include "clearway/v1/follow_service.pb.h"

namespace clearway {

// Makes each difference once, for all who follow at the same pace. Any thread may call any method.
class DeltaCache {
 public:
  // `instance`: of the server, for the messages.
  explicit DeltaCache(std::string instance) : instance_(std::move(instance)) {}

  using Messages = std::vector<v1::FollowSceneResponse>;
  // The messages that bring a mirror from one version, or from nothing (null), to another. Whoever
  // asks first makes them, the others wait. Kept as long as somebody holds them, and the ones asked
  // for last.
  std::shared_ptr<const Messages> Between(const SceneSnapshot* from, const SceneSnapshot& to,
                                          MapDetail detail);

 private:
  struct Slot {
    std::once_flag made;
    Messages messages;
  };
  using Key = std::tuple<std::uint64_t, std::uint64_t, MapDetail>;
  std::shared_ptr<Slot> SlotOf(const Key& key);

  const std::string instance_;
  std::mutex mutex_;
  std::map<Key, std::weak_ptr<Slot>> slots_;
  std::map<MapDetail, std::shared_ptr<Slot>> last_;
};

// A message without a part of a difference.
v1::FollowSceneResponse AboutVersion(const SceneSnapshot& scene, const std::string& instance);

}  // namespace clearway
