// What every handler does around its work.
#pragma once

#include <grpcpp/grpcpp.h>

#include <exception>
#include <new>

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

// RESOURCE_EXHAUSTED for a message above max_message_bytes.
absl::Status CheckSize(const ServerCore& core, const google::protobuf::Message& request);

// Runs body() -> absl::Status as one call of at most max_calls, and keeps third parties' exceptions
// from the transport: they are INTERNAL, and never the client's doing.
template <class Body>
grpc::Status HandleStream(ServerCore& core, const char* name, Body&& body) {
  try {
    const Slot slot(core.calls, core.config.limits.max_calls);
    if (!slot.ok()) return ToGrpc(TooMany("calls", core.config.limits.max_calls));
    const absl::Status status = body();
    const bool cut_off = core.cancelling && absl::IsCancelled(status);
    return ToGrpc(cut_off ? DrainingError() : status);
  } catch (const std::bad_alloc&) {
    return ToGrpc(NoMemory(name));
  } catch (const std::exception& e) {
    return ToGrpc(InternalFault(name, e));
  }
}

// HandleStream for a call whose client sends one message.
template <class Body>
grpc::Status Handle(ServerCore& core, const char* name, const google::protobuf::Message& request,
                    Body&& body) {
  return HandleStream(core, name, [&]() -> absl::Status {
    if (absl::Status status = CheckSize(core, request); !status.ok()) return status;
    return body();
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

// Handle for a query: body(scene, gone) -> absl::Status on the version that the request asks for.
template <class Request, class Body>
grpc::Status HandleQuery(ServerCore& core, const char* name, const grpc::ServerContext* context,
                         const Request& request, Body&& body) {
  return Handle(core, name, request, [&]() -> absl::Status {
    const Gone gone = GoneOf(core, context);
    absl::StatusOr<ScenePtr> scene = core.SceneFor(request.selector(), gone);
    if (!scene.ok()) return scene.status();
    return body(**scene, WorkOf(core, context));
  });
}

// Queues a change and waits until it is published.
template <class Response>
absl::Status ApplyChange(ServerCore& core, const grpc::ServerContext* context,
                         Ingestor::Change change, bool forget_answers, Response* response) {
  absl::StatusOr<Ingestor::Ticket> ticket = core.ingestor.Apply(std::move(change), forget_answers);
  if (!ticket.ok()) return ticket.status();
  const Ingestor::Answer answer = Ingestor::Wait(*ticket, GoneOf(core, context));
  if (!answer.ok()) return answer.status();
  Write(static_cast<const Versioned&>(*answer), response->mutable_scene());
  return absl::OkStatus();
}

}  // namespace clearway
