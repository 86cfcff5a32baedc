// Where the server listens.
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace clearway {

// A host and port, or a Unix socket. A plain value.
struct ListenAddress {
  std::string socket_path;  // empty: host and port
  std::string host;         // a name or number, IPv6 without brackets
  int port = 0;             // 0: any free one

  // As gRPC and clients write it.
  std::string ToString() const;
  // Whether only this machine can connect to it.
  bool IsLocal() const;
};

// "host:port", "[IPv6]:port" or "unix:path"; gRPC's prefixes ipv4:, ipv6: and dns: may stand before
// the host. A host of digits and dots is four numbers (not 127.1). INVALID_ARGUMENT saying what is
// wrong.
absl::StatusOr<ListenAddress> ParseListenAddress(const std::string& text);

// INVALID_ARGUMENT if no address is known for the host. May ask a name server.
absl::Status CheckResolves(const ListenAddress& address);

// Why the server could not listen there: the address is in use (ALREADY_EXISTS), is not this
// machine's or does not resolve (NOT_FOUND), the socket's folder is missing (NOT_FOUND), there is
// no permission (PERMISSION_DENIED), and so on. OK if nothing speaks against it.
absl::Status CheckCanListen(const ListenAddress& address);

}  // namespace clearway
