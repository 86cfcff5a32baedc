// What every call of the client library shares: channel, deadline, retries, errors.
#pragma once

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "absl/status/statusor.h"
#include "clearway/client/connection.h"
#include "clearway/v1/check_service.grpc.pb.h"
#include "clearway/v1/follow_service.grpc.pb.h"
#include "clearway/v1/ingest_service.grpc.pb.h"
#include "clearway/v1/lease_service.grpc.pb.h"
#include "clearway/v1/map_service.grpc.pb.h"
#include "clearway/v1/object_service.grpc.pb.h"
#include "clearway/v1/occupancy_service.grpc.pb.h"
#include "clearway/v1/plan_service.grpc.pb.h"
#include "clearway/v1/server_service.grpc.pb.h"
#include "wire/unread_output.h"

namespace clearway {

struct Connection::Impl {
  std::string address;
  ConnectionOptions options;
  ServerInfo server;
  std::shared_ptr<grpc::Channel> channel;
  std::optional<UnreadOutput> unread;  // of a Unix socket
  std::unique_ptr<v1::CheckService::Stub> check;
  std::unique_ptr<v1::FollowService::Stub> follow;
  std::unique_ptr<v1::IngestService::Stub> ingest;
  std::unique_ptr<v1::LeaseService::Stub> lease;
  std::unique_ptr<v1::MapService::Stub> map;
  std::unique_ptr<v1::ObjectService::Stub> object;
  std::unique_ptr<v1::OccupancyService::Stub> occupancy;
  std::unique_ptr<v1::PlanService::Stub> plan;
  std::unique_ptr<v1::ServerService::Stub> info;
};

// With the google.rpc details as payloads.
absl::Status FromGrpc(const grpc::Status& status);

// Until the channel is connected, but half a second at most, and no longer than `stop` allows.
// While nobody waits for anything gRPC looks at its sockets only every five seconds: what it
// reports to a call then is old, such as that a server refuses connections that has long been back.
template <class Stop>
void AwaitConnection(grpc::Channel& channel, Stop&& stop) {
  constexpr std::chrono::milliseconds kLook(50);
  for (int looks = 0; looks < 10 && !stop(); ++looks) {
    if (channel.WaitForConnected(std::chrono::system_clock::now() + kLook)) return;
  }
}

// Calls attempt(grpc::ClientContext*) -> grpc::Status until it ends with anything but UNAVAILABLE,
// within the connection's deadline and patience.
template <class Attempt>
absl::Status CallWithRetries(const ConnectionOptions& options, Attempt&& attempt) {
  using Clock = std::chrono::system_clock;  // what gRPC counts deadlines in
  const auto start = Clock::now();
  const auto deadline = start + std::chrono::duration_cast<Clock::duration>(options.deadline);
  const auto give_up =
      std::min(deadline, start + std::chrono::duration_cast<Clock::duration>(options.retry_for));
  std::chrono::milliseconds pause(20);
  while (true) {
    grpc::ClientContext context;
    context.set_deadline(deadline);
    const grpc::Status status = attempt(&context);
    if (status.error_code() != grpc::StatusCode::UNAVAILABLE || Clock::now() + pause > give_up) {
      return FromGrpc(status);
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(1000));
  }
}

// One unary call.
template <class Stub, class Request, class Response>
absl::StatusOr<Response> Call(const ConnectionOptions& options, Stub& stub,
                              grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&,
                                                           Response*),
                              const Request& request) {
  Response response;
  absl::Status status = CallWithRetries(options, [&](grpc::ClientContext* context) {
    response.Clear();
    return (stub.*method)(context, request, &response);
  });
  if (!status.ok()) return status;
  return response;
}

}  // namespace clearway
