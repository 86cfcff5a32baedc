// What gRPC is told about connections.
#pragma once

#include <grpcpp/server_builder.h>

#include "server/config.h"

namespace clearway {

// Message sizes, streams, threads, keepalive. Compressed messages are refused (UNIMPLEMENTED).
void SetTransport(const ServerConfig& config, grpc::ServerBuilder& builder);

}  // namespace clearway
