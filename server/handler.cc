#include "server/handler.h"

#include <cstdint>
#include <random>

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

}  // namespace

grpc::Status ToGrpc(const absl::Status& status) {
  if (status.ok()) return grpc::Status::OK;
  const google::rpc::Status proto = ToProto(status);
  return {static_cast<grpc::StatusCode>(proto.code()), proto.message(), proto.SerializeAsString()};
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

absl::Status CheckSize(const ServerCore& core, const google::protobuf::Message& request) {
  const std::uint64_t limit = core.config.limits.max_message_bytes;
  const std::uint64_t size = request.ByteSizeLong();
  return size > limit ? LimitError("request", size, limit) : absl::OkStatus();
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
