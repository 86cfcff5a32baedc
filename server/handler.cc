#include "server/handler.h"

#include "spdlog/spdlog.h"

namespace clearway {

grpc::Status ToGrpc(const absl::Status& status) {
  if (status.ok()) return grpc::Status::OK;
  const google::rpc::Status proto = ToProto(status);
  return {static_cast<grpc::StatusCode>(proto.code()), proto.message(), proto.SerializeAsString()};
}

absl::Status InternalFault(const char* name, const std::exception& exception) {
  spdlog::error("{} failed: {}", name, exception.what());
  return absl::InternalError("the server failed; its log says why");
}

}  // namespace clearway
