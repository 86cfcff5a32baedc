// gRPC's reflection, for clients such as grpcurl.
#pragma once

#include "absl/status/status.h"

namespace clearway {

// For all servers of this process that start from now on. gRPC's library offers it as soon as it is
// loaded, so it is loaded only then. UNAVAILABLE if it is not installed.
absl::Status OfferReflection();

}  // namespace clearway
