// Where the server listens.
#pragma once

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

// Why the server could not listen there: the address is in use (ALREADY_EXISTS), is not this
// machine's or does not resolve (NOT_FOUND), the socket's folder is missing (NOT_FOUND), there is
// no permission (PERMISSION_DENIED), and so on. OK if nothing speaks against it.
absl::Status CheckCanListen(const ListenAddress& address);

}  // namespace clearway
