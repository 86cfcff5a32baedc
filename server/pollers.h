// How many threads wait for calls.
#pragma once

#include <grpcpp/server_builder.h>

namespace clearway {

// With gRPC's one and two, each call that is taken up makes a new thread to wait for the next.
inline void SetPollers(grpc::ServerBuilder& builder) {
  builder.SetSyncServerOption(grpc::ServerBuilder::MIN_POLLERS, 2);
  builder.SetSyncServerOption(grpc::ServerBuilder::MAX_POLLERS, 4);
}

}  // namespace clearway
