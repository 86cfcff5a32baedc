// A connection to a Clearway server.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// How calls behave. A plain value.
struct ConnectionOptions {
  // Of every call but the long streams.
  Duration deadline = std::chrono::seconds(10);
  // How long a call that ends with UNAVAILABLE (and no other) is tried again, with growing pauses;
  // zero: once. Never beyond `deadline`.
  Duration retry_for = std::chrono::seconds(5);
  // TLS with these root certificates (a PEM file); empty: plain text, for loopback and Unix
  // sockets.
  std::string tls_root_certificates_file;
};

// What a server refuses to exceed; read with GetServerInfo. A plain value.
struct ServerLimits {
  std::uint64_t max_message_bytes = 0;
  std::uint64_t max_points_per_frame = 0;
  std::uint64_t max_objects = 0;
  double max_coordinate_m = 0;
  std::uint64_t max_states_per_batch = 0;
  std::uint64_t max_points_per_query = 0;
  std::uint64_t max_robots = 0;
  std::uint64_t max_links_per_robot = 0;
  std::uint64_t max_triangles_per_robot = 0;
  std::uint64_t max_leases = 0;
  double max_lease_ttl_s = 0;
  std::uint64_t max_follow_streams = 0;
  std::uint64_t max_push_streams = 0;
  std::uint64_t max_frames_in_flight = 0;
  std::uint64_t max_queued_frames = 0;
  std::uint64_t max_remembered_answers = 0;
  double max_version_wait_s = 0;
  std::uint64_t max_prior_bytes = 0;
  std::uint64_t max_boxes = 0;
};

struct ServerInfo {
  std::string version;   // of the software
  std::string instance;  // differs for each start of a server
  ServerLimits limits;
  SceneParams params;
};

// A channel to one server, shared by everything that talks to it. Any thread may use it; everything
// made from it keeps it alive.
class Connection {
 public:
  // `address` as gRPC writes it: "127.0.0.1:50151", "unix:/run/clearway.sock". Connects and reads
  // the server's information: UNAVAILABLE if nobody answers within the deadline.
  static absl::StatusOr<std::shared_ptr<Connection>> Open(const std::string& address,
                                                          const ConnectionOptions& options = {});
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const std::string& address() const;
  const ConnectionOptions& options() const;
  const ServerInfo& server() const;  // as of Open

  struct Impl;  // the gRPC channel and stubs; private to the layer
  Impl& impl() const { return *impl_; }

 private:
  explicit Connection(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
