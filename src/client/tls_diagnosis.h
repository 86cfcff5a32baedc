// Why a connection with or without TLS failed.
#pragma once

#include <string>

#include "wire/server_address.h"

namespace clearway {

// gRPC tells no reasons, so this connects once more, shakes hands by TLS, and says what came of it,
// for a user: that the certificate has expired, is not valid yet, was signed by another authority
// or is another host's; that one side talks TLS and the other does not (a guess, and said so).
// Empty if nobody listens, or nothing is wrong with TLS. `roots_file` is empty for a client without
// TLS. Takes two seconds at most for each address of the host.
std::string DiagnoseTls(const ServerAddress& address, const std::string& roots_file);

}  // namespace clearway
