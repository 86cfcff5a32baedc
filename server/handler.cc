#include "server/handler.h"

#include <cstdint>
#include <random>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "google/protobuf/unknown_field_set.h"
#include "spdlog/spdlog.h"

namespace clearway {
namespace {

constexpr int kMarkField = 536'870'911;  // protobuf's highest; no message of ours has it

// Of this process, so that no client can know it.
std::uint64_t MarkValue() {
  static const std::uint64_t value = std::random_device()();
  return value;
}

// On one line, whatever a client has written.
std::string ForLog(const absl::Status& status) { return absl::CHexEscape(status.message()); }

std::string NameForLog(const std::string& name, const grpc::ServerContext& context) {
  const std::string connection = context.peer();
  return name == connection ? name : absl::StrCat(name, " (", connection, ")");
}

}  // namespace

grpc::Status ToGrpc(const absl::Status& status) {
  if (status.ok()) return grpc::Status::OK;
  const google::rpc::Status proto = ToProto(status);
  return {static_cast<grpc::StatusCode>(proto.code()), proto.message(), proto.SerializeAsString()};
}

absl::StatusOr<Peer> Admit(const ServerCore& core, const grpc::ServerContext& context,
                           const char* method) {
  absl::StatusOr<Peer> peer = core.access.Identify(context);
  absl::Status status = peer.status();
  if (peer.ok()) status = CheckRole(*peer, method);
  if (status.ok()) return peer;
  spdlog::warn("audit: {} refused to {}: {}", method,
               NameForLog(peer.ok() ? peer->name : "somebody", context), ForLog(status));
  return status;
}

void Audit(const Peer& peer, const grpc::ServerContext& context, const char* method,
           const absl::Status& status) {
  if (RoleFor(method) != Role::kAdmin) return;
  spdlog::info("audit: {} by {}: {}", method, NameForLog(peer.name, context),
               status.ok() ? "done" : ForLog(status));
}

absl::Status InternalFault(const char* name, const std::exception& exception) {
  spdlog::error("{} failed: {}", name, exception.what());
  return absl::InternalError("the server failed; its log says why");
}

absl::Status NoMemory(const char* name) {
  spdlog::error("{} failed: no memory", name);
  return WithReason(absl::ResourceExhaustedError("the server has no memory for the answer"),
                    "NO_MEMORY");
}

RequestMemory::Share ShareOf(ServerCore& core, const google::protobuf::Message& request) {
  const std::uint64_t limit = core.config.limits.max_message_bytes;
  const std::uint64_t size = request.ByteSizeLong();
  if (size > limit) return RequestMemory::Share(LimitError("request", size, limit));
  return core.request_memory.Take(size);
}

void Mark(google::protobuf::Message& message) {
  message.Clear();
  message.GetReflection()->MutableUnknownFields(&message)->AddVarint(kMarkField, MarkValue());
}

bool IsMarked(const google::protobuf::Message& message) {
  const auto& unknown = message.GetReflection()->GetUnknownFields(message);
  return unknown.field_count() == 1 && unknown.field(0).number() == kMarkField &&
         unknown.field(0).varint() == MarkValue();
}

absl::Status GarbageError() {
  return FieldError("request", "its bytes are no message of the method's type");
}

}  // namespace clearway
