// What every handler does around its work.
#pragma once

#include <grpcpp/grpcpp.h>

#include <exception>
#include <new>
#include <type_traits>

#include "google/protobuf/message.h"
#include "server/core.h"
#include "server/work.h"
#include "wire/frame_wire.h"
#include "wire/geometry_wire.h"
#include "wire/scene_wire.h"
#include "wire/status.h"

namespace clearway {

// With google.rpc details.
grpc::Status ToGrpc(const absl::Status& status);

absl::Status InternalFault(const char* name, const std::exception& exception);
absl::Status NoMemory(const char* name);  // RESOURCE_EXHAUSTED

// What the request takes of the memory for requests; RESOURCE_EXHAUSTED in its status for one above
// max_message_bytes, and when there is too little left.
RequestMemory::Share ShareOf(ServerCore& core, const google::protobuf::Message& request);

// Who makes the call: UNAUTHENTICATED, or PERMISSION_DENIED if that client may not, which the log
// tells.
absl::StatusOr<Peer> Admit(const ServerCore& core, const grpc::ServerContext& context,
                           const char* method);
// Writes a line to the log for each call that only an administrator may make.
void Audit(const Peer& peer, const grpc::ServerContext& context, const char* method,
           const absl::Status& status);

// body(call), body(peer) or body(), as it takes it.
template <class Body>
absl::Status RunBody(Body&& body, OpenCalls::Call& call) {
  if constexpr (std::is_invocable_v<Body, OpenCalls::Call&>) {
    return body(call);
  } else if constexpr (std::is_invocable_v<Body, const Peer&>) {
    return body(call.peer());
  } else {
    return body();
  }
}

// Runs the body (see RunBody) as one of the calls that clients may have open, if this client may
// make it. Third parties' exceptions are kept from the transport: they are INTERNAL, and never the
// client's doing.
template <class Body>
grpc::Status HandleStream(ServerCore& core, grpc::ServerContext* context, const char* method,
                          Body&& body) {
  try {
    const absl::StatusOr<Peer> peer = Admit(core, *context, method);
    if (!peer.ok()) return ToGrpc(peer.status());
    OpenCalls::Call call(core.open_calls, *context, *peer, method);
    if (!call.status().ok()) return ToGrpc(call.status());
    absl::Status status = RunBody(body, call);
    if (core.cancelling && absl::IsCancelled(status)) status = DrainingError();
    Audit(*peer, *context, method, status);
    return ToGrpc(status);
  } catch (const std::bad_alloc&) {
    return ToGrpc(NoMemory(method));
  } catch (const std::exception& e) {
    return ToGrpc(InternalFault(method, e));
  }
}

// HandleStream for a call whose client sends one message.
template <class Body>
grpc::Status Handle(ServerCore& core, grpc::ServerContext* context, const char* method,
                    const google::protobuf::Message& request, Body&& body) {
  return HandleStream(core, context, method, [&](OpenCalls::Call& call) -> absl::Status {
    const RequestMemory::Share share = ShareOf(core, request);
    if (!share.status().ok()) return share.status();
    return RunBody(body, call);
  });
}

// Handle for a call that is answered with one message, too.
template <class Body>
grpc::Status HandleUnary(ServerCore& core, grpc::ServerContext* context, const char* method,
                         const google::protobuf::Message& request,
                         const google::protobuf::Message& response, Body&& body) {
  return Handle(core, context, method, request, [&](OpenCalls::Call& call) -> absl::Status {
    if (absl::Status status = RunBody(body, call); !status.ok()) return status;
    RequestMemory::Share share = core.request_memory.Take(response.ByteSizeLong());
    const absl::Status status = share.status();
    call.Keep(std::move(share));
    return status;
  });
}

// What a stream's next message is.
enum class Received { kMessage, kEnd, kGarbage };

// Marks the message, so that a read that parses nothing can be told from one that fails to parse:
// protobuf clears a message before it parses, and gRPC leaves it alone when there is none.
void Mark(google::protobuf::Message& message);
bool IsMarked(const google::protobuf::Message& message);

// Reads the stream's next message. gRPC alone reports bytes that are no message as the stream's
// end.
template <class Stream, class Request>
Received ReadNext(Stream& stream, Request& request, grpc::ServerContext& context,
                  StreamWatch& watch) {
  const StreamWatch::Turn turn(watch, context, StreamWatch::For::kReading);
  Mark(request);
  if (stream.Read(&request)) return Received::kMessage;
  return IsMarked(request) ? Received::kEnd : Received::kGarbage;
}

// INVALID_ARGUMENT for bytes that are no message of the method's type.
absl::Status GarbageError();

// HandleUnary for a query: body(scene, gone) -> absl::Status on the version that the request asks
// for.
template <class Request, class Body>
grpc::Status HandleQuery(ServerCore& core, grpc::ServerContext* context, const char* method,
                         const Request& request, const google::protobuf::Message& response,
                         Body&& body) {
  return HandleUnary(core, context, method, request, response, [&]() -> absl::Status {
    const Gone gone = GoneOf(core, context);
    absl::StatusOr<ScenePtr> scene = core.SceneFor(request.selector(), gone);
    if (!scene.ok()) return scene.status();
    return body(**scene, WorkOf(core, context));
  });
}

// Queues a change and waits until it is published.
template <class Response>
absl::Status ApplyChange(ServerCore& core, const grpc::ServerContext* context,
                         Ingestor::Change change, Ingestor::Effect effect, Response* response) {
  absl::StatusOr<Ingestor::Ticket> ticket = core.ingestor.Apply(std::move(change), effect);
  if (!ticket.ok()) return ticket.status();
  const Ingestor::Answer answer = Ingestor::Wait(*ticket, GoneOf(core, context));
  if (!answer.ok()) return answer.status();
  Write(static_cast<const Versioned&>(*answer), response->mutable_scene());
  return absl::OkStatus();
}

}  // namespace clearway
