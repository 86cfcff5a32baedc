// Converters of server_service.proto.
#pragma once

#include "absl/status/statusor.h"
#include "clearway/v1/server_service.pb.h"
#include "clearway/wire/server_info.h"

namespace clearway {

void Write(const ServerInfo& info, v1::GetServerInfoResponse* proto);
absl::StatusOr<ServerInfo> ReadServerInfo(const v1::GetServerInfoResponse& proto);

void Write(const ServerStatus& status, v1::GetStatusResponse* proto);
absl::StatusOr<ServerStatus> ReadServerStatus(const v1::GetStatusResponse& proto);

}  // namespace clearway
