// Details for the errors that gRPC itself makes.
#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>

namespace clearway {

// Sees every status before it is sent. One without google.rpc details is not ours: it gets them,
// and what gRPC calls INTERNAL because a request's bytes are no message of its type becomes
// INVALID_ARGUMENT.
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> MakeStatusInterceptor();

}  // namespace clearway
