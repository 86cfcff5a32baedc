#include "server/server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <sys/stat.h>

#include <algorithm>
#include <future>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "absl/strings/str_cat.h"
#include "server/core.h"
#include "server/listen_address.h"
#include "server/pollers.h"
#include "server/services.h"
#include "server/status_interceptor.h"
#include "server/tls_files.h"
#include "spdlog/spdlog.h"
#include "wire/unread_output.h"

namespace clearway {
namespace {

// That calls may take to end once they are told to.
constexpr std::chrono::milliseconds kLastAnswers(200);
// That connections may take after that, if there is time, and in any case; those whose client reads
// nothing are cut within.
constexpr std::chrono::milliseconds kLastBytes(4000), kLeastLastBytes(500), kLastReads(1000);
constexpr int kMaxPingStrikes = 2;  // pings that come too early before a client is disconnected
constexpr int kSpareThreads = 64;   // of gRPC's own, beyond one per call

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> CredentialsOf(const ServerConfig& config) {
  if (config.tls_cert.empty()) return grpc::InsecureServerCredentials();
  absl::StatusOr<TlsFiles> files = ReadTlsFiles(config.tls_cert, config.tls_key);
  if (!files.ok()) return files.status();
  if (!files->warning.empty()) spdlog::warn("{}", files->warning);
  grpc::SslServerCredentialsOptions options;
  options.pem_key_cert_pairs.push_back({std::move(files->key), std::move(files->cert)});
  return grpc::SslServerCredentials(options);
}

void SetLimits(const ServerLimits& limits, grpc::ServerBuilder& builder) {
  // Handlers refuse what is above max_message_bytes, and name the field; the transport cannot, so
  // it only keeps the rest from being taken in.
  constexpr std::uint64_t kMostOfGrpc = std::numeric_limits<int>::max();
  builder.SetMaxReceiveMessageSize(
      static_cast<int>(std::min(2 * limits.max_message_bytes, kMostOfGrpc)));
  builder.SetMaxSendMessageSize(-1);  // replies are bounded by the limits on questions
  // Two servers on one port would share its clients at random.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  SetPollers(builder);
  grpc::ResourceQuota quota("clearway");
  quota.SetMaxThreads(static_cast<int>(limits.max_calls) + kSpareThreads);
  builder.SetResourceQuota(quota);
}

// A peer that vanished without a word is found by pings, and its streams end.
void SetKeepalive(const KeepaliveConfig& keepalive, grpc::ServerBuilder& builder) {
  const auto set = [&](const char* argument, Duration duration) {
    builder.AddChannelArgument(argument, static_cast<int>(duration.count() / 1'000'000));
  };
  set(GRPC_ARG_KEEPALIVE_TIME_MS, keepalive.time);
  set(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, keepalive.timeout);
  // Connections without calls and streams without data are pinged as well, and may ping.
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  set(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, keepalive.min_client_ping);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PING_STRIKES, kMaxPingStrikes);
  // Likewise one that connects and says nothing.
  set(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, keepalive.time + keepalive.timeout);
}

// What is created meanwhile only its owner can use.
class OwnersOnly {
 public:
  OwnersOnly() : before_(umask(S_IRWXG | S_IRWXO | S_IXUSR)) {}
  ~OwnersOnly() { umask(before_); }
  OwnersOnly(const OwnersOnly&) = delete;
  OwnersOnly& operator=(const OwnersOnly&) = delete;

 private:
  const mode_t before_;
};

using Clock = std::chrono::steady_clock;

// Until no call but open push streams is running; those may stay idle for ever.
void WaitForCalls(const ServerCore& core, Clock::time_point end) {
  while (core.calls > core.push_streams && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

struct Server::Impl {
  explicit Impl(const ServerConfig& config) : core(config) {}

  ServerCore core;
  CheckHandlers check{core};
  FollowHandlers follow{core};
  IngestHandlers ingest{core};
  LeaseHandlers lease{core};
  MapHandlers map{core};
  ObjectHandlers object{core};
  OccupancyHandlers occupancy{core};
  PlanHandlers plan{core};
  InfoHandlers info{core};
  std::unique_ptr<grpc::Server> server;
  std::optional<UnreadOutput> unread;  // of a Unix socket
  std::string address;
  std::once_flag drained;
  std::future<void> ended;  // of the transport, while it ends
  bool ended_in_time = false;
};

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() {
  Drain();
  impl_->ended.wait();
}

const std::string& Server::address() const { return impl_->address; }
ServerCore& Server::core() { return impl_->core; }

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& config) {
  absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> credentials = CredentialsOf(config);
  if (!credentials.ok()) return credentials.status();
  absl::StatusOr<ListenAddress> listen = ParseListenAddress(config.listen);
  if (!listen.ok()) return listen.status();
  if (auto status = CheckCanListen(*listen); !status.ok()) return status;
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  auto impl = std::make_unique<Impl>(config);
  grpc::ServerBuilder builder;
  SetLimits(config.limits, builder);
  SetKeepalive(config.keepalive, builder);
  int port = 0;
  builder.AddListeningPort(listen->ToString(), *credentials, &port);
  for (grpc::Service* service : std::initializer_list<grpc::Service*>{
           &impl->check, &impl->follow, &impl->ingest, &impl->lease, &impl->map, &impl->object,
           &impl->occupancy, &impl->plan, &impl->info}) {
    builder.RegisterService(service);
  }
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> interceptors;
  interceptors.push_back(MakeStatusInterceptor());
  builder.experimental().SetInterceptorCreators(std::move(interceptors));
  {
    const OwnersOnly owners_only;  // of the socket's file
    impl->server = builder.BuildAndStart();
  }
  if (impl->server == nullptr || port == 0) {
    return absl::UnavailableError(absl::StrCat("listen: cannot listen on ", listen->ToString(),
                                               "; gRPC's line above says why"));
  }
  if (listen->socket_path.empty()) listen->port = port;  // the one that was chosen
  impl->address = listen->ToString();
  if (!listen->socket_path.empty()) {
    impl->unread.emplace(BoundPath(listen->socket_path), UnreadOutput::End::kServer,
                         config.keepalive.time + config.keepalive.timeout);
  }
  impl->server->GetHealthCheckService()->SetServingStatus(true);
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

bool Server::Drain() {
  std::call_once(impl_->drained, [&] {
    ServerCore& core = impl_->core;
    const Clock::time_point end = Clock::now() + core.config.drain;
    core.draining = true;
    impl_->server->GetHealthCheckService()->SetServingStatus(false);
    const bool applied = core.ingestor.Drain(end);
    core.versions.Close();
    WaitForCalls(core, end);
    core.cancelling = true;
    core.streams.EndAll(std::string(DrainingError().message()));
    if (impl_->unread) impl_->unread->SetPatience(kLastReads);
    impl_->ended = std::async(std::launch::async, [&server = *impl_->server] {
      server.Shutdown(std::chrono::system_clock::now() + kLastAnswers);
      server.Wait();
    });
    const Clock::time_point now = Clock::now() + kLastAnswers;
    const Clock::time_point last = std::max(std::min(now + kLastBytes, end), now + kLeastLastBytes);
    impl_->ended_in_time = impl_->ended.wait_until(last) == std::future_status::ready && applied;
  });
  return impl_->ended_in_time;
}

}  // namespace clearway
