// Sockets that listen.
#pragma once

#include <sys/types.h>

#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "server/descriptor.h"
#include "server/listen_address.h"

namespace clearway {

struct ListenOptions {
  Duration unread_timeout;    // of TCP connections: after which bytes that nobody takes end them
  mode_t socket_mode = 0600;  // of a Unix socket's file
};

// Opens a socket for each of the host's addresses, or the Unix socket, in the place of one that
// nobody holds any more. Port 0 becomes the one that was chosen. Errors begin with "listen: ": the
// address is in use (ALREADY_EXISTS), is not this machine's or does not resolve (NOT_FOUND), the
// socket's folder is missing (NOT_FOUND), there is no permission (PERMISSION_DENIED), and so on.
absl::StatusOr<std::vector<Descriptor>> Listen(ListenAddress& address,
                                               const ListenOptions& options);

}  // namespace clearway
