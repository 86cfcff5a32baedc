// Those who use a server for hours.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "absl/status/status.h"
#include "clearway/client/connection.h"
#include "clearway/client/remote_planner.h"
#include "clearway/geometry/aabb.h"
#include "soak/looped_frames.h"

namespace clearway::soak {

// What went wrong. Any thread may call any method.
class Faults {
 public:
  void Note(const std::string& who, const absl::Status& status);
  void Note(const std::string& who, const std::string& what);
  std::vector<std::string> first() const;  // some of them
  std::uint64_t count() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> first_;
  std::uint64_t count_ = 0;
};

// What clients have done. Any thread may read it.
struct Tally {
  std::atomic<std::uint64_t> frames = 0, frames_applied = 0, sensor_restarts = 0;
  std::atomic<std::uint64_t> batches = 0, news = 0;
};

// Everyone runs in a thread of its own until `stop`.
struct Everyone {
  std::string address;
  std::atomic<bool> stop = false;
  Faults faults;
  Tally tally;
};

// The recording and the bridged object at 10 Hz; their sensors restart every 20 s.
void RunSensors(Everyone& all, LoopedFrames frames, BridgedObject bridged);
// Twice a second: pins the newest version, checks states and motions in the box, lets go.
void RunPlanner(Everyone& all, const Aabb& box_W, std::uint64_t seed);
// Watches motions in the box, and others when they are over; after `stop` it ends with the next
// news, at the latest with the server.
void RunWatcher(Everyone& all, const Aabb& box_W, std::uint64_t seed);

}  // namespace clearway::soak
