// Addresses of servers.
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace clearway {

// A host and port, or a Unix socket. A plain value.
struct ServerAddress {
  std::string socket_path;  // empty: host and port
  std::string host;         // a name or number, IPv6 without brackets
  int port = 0;

  // As gRPC and clients write it.
  std::string ToString() const;
  // As gRPC resolves it with the least effort: numbers need no name server.
  std::string ToTarget() const;
};

// What an address is for. A plain value.
struct AddressUse {
  std::string field;    // that messages name
  int min_port = 1;     // 0 where the system may choose
  std::string example;  // of a host, for an address that lacks one
};

// "host:port", "[IPv6]:port" or "unix:path"; gRPC's prefixes ipv4:, ipv6: and dns: may stand before
// the host. A host of digits and dots is four numbers (not 127.1). INVALID_ARGUMENT saying what is
// wrong, and for URLs and paths what to write instead.
absl::StatusOr<ServerAddress> ParseServerAddress(const std::string& text, const AddressUse& use);

}  // namespace clearway
