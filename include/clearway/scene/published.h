// The newest version, from one writer to many readers.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace clearway {

// A slot for the newest immutable value. Any thread may call any method; the lock is held for one
// pointer copy.
template <class T>
class Published {
 public:
  std::shared_ptr<const T> Get() const {
    std::lock_guard lock(mutex_);
    return value_;
  }
  void Set(std::shared_ptr<const T> value) {
    std::lock_guard lock(mutex_);
    value_.swap(value);  // the old value, if this was its last owner, is freed after the lock
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

}  // namespace clearway
