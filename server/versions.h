// The published versions of the scene.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>

#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// Tells whether whoever asked has gone: a cancelled call, a passed deadline.
using Gone = std::function<bool()>;

// The newest version and a few before it, so that a mirror that fell behind gets a difference
// instead of everything. The writer publishes; any thread may call the rest.
class Versions {
 public:
  // Keeps `kept` versions beside the newest.
  explicit Versions(std::size_t kept) : kept_(kept) {}

  void Publish(ScenePtr scene);
  // Drops those before the newest: mirrors that fell behind get everything.
  void KeepNewestOnly();
  ScenePtr Newest() const;                     // null before the first
  ScenePtr Find(std::uint64_t version) const;  // null if it is not kept
  // The newest, once it is at least `version`; null when `timeout` has passed, `gone` says so, or
  // after Close.
  ScenePtr WaitFor(std::uint64_t version, Duration timeout, const Gone& gone) const;
  // Wakes everyone who waits; nobody waits any more.
  void Close();
  bool closed() const;

 private:
  const std::size_t kept_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::deque<ScenePtr> scenes_;  // ascending versions
  bool closed_ = false;
};

}  // namespace clearway
