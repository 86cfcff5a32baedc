// What happens to every call outside of its handler.
#pragma once

#include <grpcpp/support/server_interceptor.h>

#include <memory>

#include "server/open_calls.h"

namespace clearway {

// Sees every status before it is sent. One without google.rpc details is not ours: it gets them,
// and what gRPC calls INTERNAL because a request's bytes are no message of its type becomes
// INVALID_ARGUMENT. Tells `calls` of every call's end, which is when its reply has been sent.
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> MakeCallInterceptor(
    OpenCalls& calls);

}  // namespace clearway
