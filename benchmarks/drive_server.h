// A server in this process that has seen a real drive.
#pragma once

#include <memory>
#include <vector>

#include "clearway/scene/frame.h"
#include "load/questions.h"
#include "server/core.h"
#include "server/server.h"

namespace clearway::bench {

// The whole scans of the drive kitti0000_full with its labelled objects and their poses (the
// simulator's street without the recordings, and it says so), again and again: forth, back, forth.
// A value.
class Drive {
 public:
  Drive();
  // 0.1 s after the one before. Valid until the next call.
  const Frame& Next();

 private:
  std::vector<Frame> frames_;
  Time first_stamp_;
  std::size_t next_ = 0;
};

// What the drive is mapped with: voxels of 0.1 m, range 50 m.
SceneParams DriveParams();

// On a free port of loopback. One thread.
class DriveServer {
 public:
  // Applies the first `scans`.
  explicit DriveServer(std::size_t scans);
  DriveServer(const DriveServer&) = delete;

  Server& server() { return *server_; }
  const std::string& address() const { return server_->address(); }
  ScenePtr Newest() { return server_->core().versions.Newest(); }
  // Applies the drive's next scan; the version that it is in.
  std::uint64_t Apply();
  // All of the static map, from now to 2 s later, in steps.
  QuestionSpace Space();
  // The part where robots drive: 30 m around the start, up to 1 m above the sensor.
  QuestionSpace GroundSpace();

 private:
  Drive drive_;
  std::unique_ptr<Server> server_;
};

}  // namespace clearway::bench
