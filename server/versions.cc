#include "server/versions.h"

#include <algorithm>
#include <chrono>

namespace clearway {
namespace {

// How often someone who waits looks whether its client is still there.
constexpr std::chrono::milliseconds kLook(20);

}  // namespace

void Versions::Publish(ScenePtr scene) {
  ScenePtr dropped;  // freed outside the lock
  {
    std::lock_guard lock(mutex_);
    if (!scenes_.empty() && scenes_.back()->version == scene->version) return;
    scenes_.push_back(std::move(scene));
    if (scenes_.size() > kept_ + 1) {
      dropped = std::move(scenes_.front());
      scenes_.pop_front();
    }
  }
  changed_.notify_all();
}

void Versions::KeepNewestOnly() {
  std::deque<ScenePtr> dropped;  // freed outside the lock
  std::lock_guard lock(mutex_);
  while (scenes_.size() > 1) {
    dropped.push_back(std::move(scenes_.front()));
    scenes_.pop_front();
  }
}

ScenePtr Versions::Newest() const {
  std::lock_guard lock(mutex_);
  return scenes_.empty() ? nullptr : scenes_.back();
}

ScenePtr Versions::Find(std::uint64_t version) const {
  std::lock_guard lock(mutex_);
  for (const ScenePtr& scene : scenes_) {
    if (scene->version == version) return scene;
  }
  return nullptr;
}

ScenePtr Versions::WaitFor(std::uint64_t version, Duration timeout, const Gone& gone) const {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  std::unique_lock lock(mutex_);
  while (true) {
    if (closed_) return nullptr;
    if (!scenes_.empty() && scenes_.back()->version >= version) return scenes_.back();
    const auto now = std::chrono::steady_clock::now();
    if (now >= deadline || gone()) return nullptr;
    changed_.wait_for(lock, std::min<std::chrono::nanoseconds>(kLook, deadline - now));
  }
}

void Versions::Close() {
  {
    std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool Versions::closed() const {
  std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace clearway
