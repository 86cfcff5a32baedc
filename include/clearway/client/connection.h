// A connection to a Clearway server.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/wire/server_info.h"

namespace clearway {

// How calls behave. A plain value.
struct ConnectionOptions {
  // Of every call but the long streams.
  Duration deadline = std::chrono::seconds(10);
  // How long a call that ends with UNAVAILABLE (and no other) is tried again, with growing pauses;
  // zero: once. Never beyond `deadline`.
  Duration retry_for = std::chrono::seconds(5);
  // The server is pinged when nothing came from it for `keepalive_time`, also between calls; the
  // connection is lost when it does not answer within `keepalive_timeout`. This keeps connections
  // alive behind NATs and finds vanished networks. Servers refuse clients that ping more often than
  // their keepalive.min_client_ping_s allows (4 s by default).
  Duration keepalive_time = std::chrono::seconds(10);
  Duration keepalive_timeout = std::chrono::seconds(20);
  // TLS with these root certificates (a PEM file); empty: plain text, for loopback and Unix
  // sockets.
  std::string tls_root_certificates_file = {};
  // With TLS: the client's certificate chain and private key, PEM files both, for servers that ask
  // for one (tls_client_ca).
  std::string tls_certificate_file = {}, tls_key_file = {};
  // A file that holds one token, for servers that ask for one (clearway token add). It is read when
  // the connection opens, and must be its owner's secret (ReadSecretFile). Without TLS it is only
  // sent to this machine, unless `insecure`.
  std::string token_file = {};
  bool insecure = false;
};

// A channel to one server, shared by everything that talks to it. Any thread may use it; everything
// made from it keeps it alive.
class Connection {
 public:
  // `address`: "host:port", "[IPv6]:port", "unix:/path" or "unix:path"; gRPC's prefixes ipv4:,
  // ipv6: and dns: may stand before a host. Connects and reads the server's information.
  // INVALID_ARGUMENT for what is no address, UNAVAILABLE if nobody answers within the deadline, or
  // if TLS is to blame (ErrorDetails::reason is TLS), saying why; UNAUTHENTICATED for a token that
  // is missing or wrong. Errors of files begin with the option's name.
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
