// A copy of a server's scene in this process.
#pragma once

#include <memory>

#include "clearway/client/connection.h"
#include "clearway/client/stream_state.h"
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
  // How often an idle server confirms that the mirror has its newest version, 0.1 s or more; zero:
  // never, and then Latest(max_age) also refuses the scene of an idle server.
  Duration heartbeat = std::chrono::seconds(1);
  ReconnectOptions reconnect = {};  // give_up_after does not count: a mirror never gives up
};

// What a mirror has done so far.
struct SceneMirrorStats {
  std::uint64_t deltas_applied = 0;
  std::uint64_t full_syncs = 0;  // deltas that started from nothing
};

// Follows a server's scene in a background thread. Versions may be skipped, but each one shown is
// the server's bit for bit (equal SceneSnapshot::Hash), or with states_only its states. When the
// connection is lost it reconnects by itself. A gap, a damaged delta or a restarted server makes it
// start again from nothing. Meanwhile the scene is stale: Latest() stays what it was, and so do the
// answers of checkers made on it, under the old version and stamp. A planner that must not act on a
// stale scene asks for Latest(max_age) and takes its error for "not free". Any thread may call any
// method.
class SceneMirror {
 public:
  // Returns once the first version is here (or the connection's deadline has passed).
  static absl::StatusOr<std::unique_ptr<SceneMirror>> Follow(
      std::shared_ptr<Connection> connection, const SceneMirrorOptions& options = {});
  ~SceneMirror();  // ends the stream

  // The last scene that came, however long ago. Never null.
  ScenePtr Latest() const;
  // The same if the server sent it, or confirmed that it is the newest, within the last `max_age`
  // of this computer's clock; else UNAVAILABLE. Meaningful above `heartbeat` and `min_interval`.
  absl::StatusOr<ScenePtr> Latest(Duration max_age) const;
  // The newest scene as soon as it is at least `version` and the mirror is connected (versions of
  // the server before a restart mean nothing); DEADLINE_EXCEEDED after `timeout` of this computer's
  // clock.
  absl::StatusOr<ScenePtr> WaitFor(std::uint64_t version, Duration timeout) const;

  StreamState state() const;
  SceneMirrorStats stats() const;

 private:
  struct Impl;
  explicit SceneMirror(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
