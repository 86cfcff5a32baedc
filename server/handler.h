// What every handler does around its work.
#pragma once

#include <grpcpp/grpcpp.h>

#include <exception>

#include "server/core.h"
#include "wire/frame_wire.h"
#include "wire/geometry_wire.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {

// With google.rpc details.
grpc::Status ToGrpc(const absl::Status& status);

inline Gone GoneOf(const grpc::ServerContext* context) {
  return [context] { return context->IsCancelled(); };
}

absl::Status InternalFault(const char* name, const std::exception& exception);

// Runs body() -> absl::Status as one call of at most max_calls, and keeps third parties' exceptions
// from the transport: they are INTERNAL, and never the client's doing.
template <class Body>
grpc::Status Handle(ServerCore& core, const char* name, Body&& body) {
  try {
    const Slot slot(core.calls, core.config.limits.max_calls);
    if (!slot.ok()) return ToGrpc(TooMany("calls", core.config.limits.max_calls));
    return ToGrpc(body());
  } catch (const std::exception& e) {
    return ToGrpc(InternalFault(name, e));
  }
}

// Handle for a query: body(scene, gone) -> absl::Status on the version that the request asks for.
template <class Request, class Body>
grpc::Status HandleQuery(ServerCore& core, const char* name, const grpc::ServerContext* context,
                         const Request& request, Body&& body) {
  return Handle(core, name, [&]() -> absl::Status {
    const Gone gone = GoneOf(context);
    absl::StatusOr<ScenePtr> scene = core.SceneFor(request.selector(), gone);
    if (!scene.ok()) return scene.status();
    return body(**scene, gone);
  });
}

}  // namespace clearway
