// A copy of a server's scene in this process.
#pragma once

#include <memory>

#include "clearway/client/connection.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// A plain value.
struct SceneMirrorOptions {
  // At most one delta in this time; zero: as fast as they can be applied. Versions in between are
  // skipped.
  Duration min_interval{0};
  // Voxels as free, occupied or unknown alone: fewer bytes, the same statuses, collisions and
  // clearances, but no log-odds (MapDetail::kStates).
  bool states_only = false;
  // Pause before a broken stream is opened again.
  Duration reconnect_after = std::chrono::milliseconds(200);
};

// What a mirror has done so far.
struct SceneMirrorStats {
  std::uint64_t deltas_applied = 0;
  std::uint64_t full_syncs = 0;  // deltas that started from nothing
  std::uint64_t resyncs = 0;     // streams opened again: gaps, damage, lost connections
  absl::Status last_error;       // of the stream that broke last
};

// Follows a server's scene in a background thread. Versions may be skipped, but each one shown is
// the server's bit for bit (equal SceneSnapshot::Hash), or with states_only its states. A gap, a
// damaged delta or another server behind the address makes it start again from nothing; meanwhile
// Latest() stays what it was. Any thread may call any method.
class SceneMirror {
 public:
  // Returns once the first version is here (or the connection's deadline has passed).
  static absl::StatusOr<std::unique_ptr<SceneMirror>> Follow(
      std::shared_ptr<Connection> connection, const SceneMirrorOptions& options = {});
  ~SceneMirror();  // ends the stream

  // Never null.
  ScenePtr Latest() const;
  // The newest scene as soon as it is at least `version`; DEADLINE_EXCEEDED after `timeout` of this
  // computer's clock.
  absl::StatusOr<ScenePtr> WaitFor(std::uint64_t version, Duration timeout) const;

  SceneMirrorStats stats() const;

 private:
  struct Impl;
  explicit SceneMirror(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
