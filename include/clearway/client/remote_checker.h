// The state checker whose scene is on a server.
#pragma once

#include <memory>

#include "clearway/client/connection.h"
#include "clearway/collision/departure_intervals.h"
#include "clearway/collision/safe_intervals.h"
#include "clearway/collision/state_checker.h"

namespace clearway {

// A plain value.
struct RemoteCheckerOptions {
  // Of the lease on the pinned version; renewed in the background well before it ends.
  Duration lease_ttl = std::chrono::seconds(30);
  // Pin at least this version (read your own writes).
  std::uint64_t min_version = 0;
};

// Checks states and motions over the network, pinned to one scene version by a lease until it is
// destroyed. Any number of threads may call it. Batches above the server's limit
// (states_per_request) are sent in pieces; every piece is answered on the same version. Fails with
// FAILED_PRECONDITION once the lease is lost (the server was unreachable for longer than the time
// to live, or restarted).
class RemoteChecker : public StateChecker {
 public:
  // Registers the robot (by the hash of its content) and pins the newest version.
  static absl::StatusOr<std::unique_ptr<RemoteChecker>> Pin(
      std::shared_ptr<Connection> connection, Robot robot,
      const RemoteCheckerOptions& options = {});
  ~RemoteChecker() override;  // releases the lease

  absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                   const CheckOptions& options) const override;
  // RESOURCE_EXHAUSTED for a motion of more than states_per_request knots.
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions& options) const override;
  // What the functions of the same names answer on this checker, but searched for by the server: in
  // one call for each states_per_request configurations or knots. The connection's deadline holds
  // for each of them; of many, or in long windows, ask in parts.
  absl::StatusOr<std::vector<std::vector<TimeInterval>>> FindSafeIntervals(
      const std::vector<Pose>& T_W_L, const TimeInterval& window,
      const SafeIntervalOptions& options) const;
  // RESOURCE_EXHAUSTED for an edge of more than states_per_request knots.
  absl::StatusOr<std::vector<std::vector<TimeInterval>>> FindDepartureIntervals(
      const MotionBatch& edges, const TimeInterval& window,
      const DepartureIntervalOptions& options) const;

  const Robot& robot() const override;
  std::uint64_t version() const override;
  Time stamp() const override;

  // How many states of this robot the server takes at once.
  std::size_t states_per_request() const;

  // Of the pinned version, for queries beside the checks (SceneQuery::lease_id).
  const std::string& lease_id() const;

 private:
  struct Impl;
  explicit RemoteChecker(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
