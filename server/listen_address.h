// Where the server listens.
#pragma once

#include <netdb.h>

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "wire/server_address.h"

namespace clearway {

// A plain value.
struct ListenAddress : ServerAddress {
  // Whether only this machine can connect to it.
  bool IsLocal() const;
};

// As ParseServerAddress; port 0 stands for any free one.
absl::StatusOr<ListenAddress> ParseListenAddress(const std::string& text);

// INVALID_ARGUMENT if no address is known for the host. May ask a name server.
absl::Status CheckResolves(const ListenAddress& address);

using AddrInfos = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

// The addresses of its host, which is no socket's path. NOT_FOUND if it has none. May ask a name
// server.
absl::StatusOr<AddrInfos> Resolve(const ListenAddress& address);

}  // namespace clearway
