#include "clearway/client/connection.h"

#include <algorithm>
#include <limits>

#include "absl/strings/str_cat.h"
#include "clearway/client/error_details.h"
#include "client/call.h"
#include "client/credentials.h"
#include "client/tls_diagnosis.h"
#include "wire/server_address.h"
#include "wire/server_wire.h"
#include "wire/status.h"

namespace clearway {
namespace {

// A server that does not answer for the sake of TLS does answer.
absl::Status Explained(const absl::Status& status, const ServerAddress& address,
                       const ConnectionOptions& options) {
  if (!absl::IsUnavailable(status) && !absl::IsDeadlineExceeded(status)) return status;
  const std::string why = DiagnoseTls(address, options.tls_root_certificates_file);
  if (why.empty()) return status;
  return WithReason(absl::Status(status.code(), absl::StrCat("a server answers at ",
                                                             address.ToString(), ", but ", why)),
                    "TLS");
}

int Milliseconds(Duration duration) {
  constexpr std::int64_t kMax = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp<std::int64_t>(duration.count() / 1'000'000, 1, kMax));
}

grpc::ChannelArguments ArgumentsOf(const ConnectionOptions& options, const ServerAddress& address) {
  grpc::ChannelArguments arguments;
  // No proxy (http_proxy, grpc_proxy) leads back to this machine, unlike gRPC's default.
  if (IsThisMachine(address)) arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  // The server's limits hold; the client sets none of its own.
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetMaxSendMessageSize(-1);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  // The time that one attempt may take, not a pause: TLS over a slow link needs seconds.
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 5000);
  // Streams and calls make pauses of their own, and an attempt of theirs should be one of gRPC's.
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, Milliseconds(options.keepalive_time));
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, Milliseconds(options.keepalive_timeout));
  arguments.SetInt(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  // Without limit: a stream may be silent for hours.
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  // A channel of its own: two connections of one process are two clients to the server.
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return arguments;
}

}  // namespace

absl::Status FromGrpc(const grpc::Status& status) {
  if (status.ok()) return absl::OkStatus();
  google::rpc::Status proto;
  if (!proto.ParseFromString(status.error_details())) proto.Clear();
  proto.set_code(status.error_code());
  proto.set_message(status.error_message());
  return FromProto(proto);
}

Connection::Connection(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Connection::~Connection() = default;

const std::string& Connection::address() const { return impl_->address; }
const ConnectionOptions& Connection::options() const { return impl_->options; }
const ServerInfo& Connection::server() const { return impl_->server; }

absl::StatusOr<std::shared_ptr<Connection>> Connection::Open(const std::string& address,
                                                             const ConnectionOptions& options) {
  static const auto* const kUse = new AddressUse{"address", 1, "127.0.0.1 is this machine"};
  const absl::StatusOr<ServerAddress> target = ParseServerAddress(address, *kUse);
  if (!target.ok()) return target.status();
  const auto credentials = ReadCredentials(options, *target);
  if (!credentials.ok()) return credentials.status();
  auto impl = std::make_unique<Impl>();
  impl->address = address;
  impl->options = options;
  impl->channel = grpc::experimental::CreateCustomChannelWithInterceptors(
      target->ToTarget(), credentials->channel, ArgumentsOf(options, *target),
      InterceptorsFor(credentials->token));
  impl->check = v1::CheckService::NewStub(impl->channel);
  impl->follow = v1::FollowService::NewStub(impl->channel);
  impl->ingest = v1::IngestService::NewStub(impl->channel);
  impl->lease = v1::LeaseService::NewStub(impl->channel);
  impl->map = v1::MapService::NewStub(impl->channel);
  impl->object = v1::ObjectService::NewStub(impl->channel);
  impl->occupancy = v1::OccupancyService::NewStub(impl->channel);
  impl->plan = v1::PlanService::NewStub(impl->channel);
  impl->info = v1::ServerService::NewStub(impl->channel);

  // A server that has just been started takes a moment to listen.
  constexpr Duration kStarting = std::chrono::seconds(3);
  impl->channel->WaitForConnected(std::chrono::system_clock::now() +
                                  std::min(options.deadline, kStarting));
  auto response = Call(options, *impl->info, &v1::ServerService::Stub::GetServerInfo,
                       v1::GetServerInfoRequest());
  if (!response.ok()) return Explained(response.status(), *target, options);
  absl::StatusOr<ServerInfo> server = ReadServerInfo(*response);
  if (!server.ok()) return server.status();
  impl->server = *std::move(server);
  if (!target->socket_path.empty()) {
    impl->unread.emplace(BoundPath(target->socket_path), UnreadOutput::End::kClient,
                         options.keepalive_time + options.keepalive_timeout);
  }
  return std::shared_ptr<Connection>(new Connection(std::move(impl)));
}

ErrorDetails DetailsOf(const absl::Status& status) {
  return {ReasonOf(status), BadFieldOf(status), RetryDelayOf(status)};
}

}  // namespace clearway
