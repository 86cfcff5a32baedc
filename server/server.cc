#include "server/server.h"

#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include "absl/strings/str_cat.h"
#include "server/acceptor.h"
#include "server/call_interceptor.h"
#include "server/core.h"
#include "server/listeners.h"
#include "server/reflection.h"
#include "server/services.h"
#include "server/tls_identity.h"
#include "server/transport.h"
#include "spdlog/spdlog.h"
#include "wire/unread_output.h"

namespace clearway {
namespace {

// That calls may take to end once they are told to.
constexpr std::chrono::milliseconds kLastAnswers(200);
// That connections may take after that, if there is time, and in any case; those whose client reads
// nothing are cut within.
constexpr std::chrono::milliseconds kLastBytes(4000), kLeastLastBytes(500), kLastReads(1000);
using Clock = std::chrono::steady_clock;

// Until no handler but those of open push streams is running; those may stay idle for ever.
void WaitForCalls(const ServerCore& core, Clock::time_point end) {
  while (core.open_calls.running() > core.push_streams.size() && Clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

struct Server::Impl {
  explicit Impl(const ServerConfig& config) : core(config) {
    core.on_room = [this](bool room) { ReportHealth(room); };
  }

  absl::Status ReadAccess();
  std::shared_ptr<grpc::ServerCredentials> Credentials() const;
  void Register(grpc::ServerBuilder& builder);
  absl::StatusOr<std::vector<Descriptor>> Listen();
  void StopListening();
  void ReportHealth(bool room);

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
  std::unique_ptr<TlsIdentity> tls;  // null: plain
  std::unique_ptr<grpc::Server> server;
  std::atomic<grpc::HealthCheckServiceInterface*> health = nullptr;  // once it serves
  std::unique_ptr<Acceptor> acceptor;
  std::optional<UnreadOutput> unread;  // of a Unix socket
  std::string address;
  std::string socket_path;  // as it is bound; empty for TCP
  std::once_flag drained;
  std::future<void> ended;  // of the transport, while it ends
  bool ended_in_time = false;
};

// All of it or nothing.
absl::Status Server::Impl::ReadAccess() {
  const ServerConfig& config = core.config;
  std::optional<TokenTable> tokens;
  if (!config.tokens.empty()) {
    absl::StatusOr<TokenTable> table = TokenTable::Read(config.tokens);
    if (!table.ok()) {
      return absl::Status(table.status().code(),
                          absl::StrCat("tokens: ", table.status().message()));
    }
    tokens = *std::move(table);
  }
  if (!config.tls_cert.empty()) {
    const auto files = ReadTlsFiles(config.tls_cert, config.tls_key, config.tls_client_ca);
    if (!files.ok()) return files.status();
    if (!files->warning.empty()) spdlog::warn("{}", files->warning);
    if (tls != nullptr) {
      if (auto status = tls->Replace(*files); !status.ok()) return status;
    } else {
      absl::StatusOr<std::unique_ptr<TlsIdentity>> made = TlsIdentity::Create(*files);
      if (!made.ok()) return made.status();
      tls = *std::move(made);
    }
  }
  core.access.ExpectCertificates(!config.tls_client_ca.empty());
  core.access.Replace(std::move(tokens));
  return absl::OkStatus();
}

std::shared_ptr<grpc::ServerCredentials> Server::Impl::Credentials() const {
  return tls == nullptr ? grpc::InsecureServerCredentials() : tls->credentials();
}

void Server::Impl::Register(grpc::ServerBuilder& builder) {
  for (grpc::Service* service : std::initializer_list<grpc::Service*>{
           &check, &follow, &ingest, &lease, &map, &object, &occupancy, &plan, &info}) {
    builder.RegisterService(service);
  }
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> interceptors;
  interceptors.push_back(MakeCallInterceptor(core.open_calls));
  builder.experimental().SetInterceptorCreators(std::move(interceptors));
  core.open_calls.ExpectEnds();
}

absl::StatusOr<std::vector<Descriptor>> Server::Impl::Listen() {
  const ServerConfig& config = core.config;
  absl::StatusOr<ListenAddress> listen = ParseListenAddress(config.listen);
  if (!listen.ok()) return listen.status();
  ListenOptions options{config.keepalive.timeout};
  options.socket_mode = ParseSocketMode(config.socket_mode).value_or(options.socket_mode);
  auto listeners = clearway::Listen(*listen, options);
  if (!listeners.ok()) return listeners;
  address = listen->ToString();
  if (listen->socket_path.empty()) return listeners;
  socket_path = BoundPath(listen->socket_path);
  unread.emplace(socket_path, UnreadOutput::End::kServer,
                 config.keepalive.time + config.keepalive.timeout);
  return listeners;
}

// Nobody can connect from now on.
void Server::Impl::StopListening() {
  acceptor->Close();
  if (!socket_path.empty()) unlink(socket_path.c_str());
}

void Server::Impl::ReportHealth(bool room) {
  if (auto* const service = health.load()) service->SetServingStatus(room && !core.draining);
}

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() {
  Drain();
  impl_->ended.wait();
}

const std::string& Server::address() const { return impl_->address; }
ServerCore& Server::core() { return impl_->core; }

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& config) {
  auto impl = std::make_unique<Impl>(config);
  if (auto status = impl->ReadAccess(); !status.ok()) return status;
  absl::StatusOr<std::vector<Descriptor>> listeners = impl->Listen();
  if (!listeners.ok()) return listeners.status();
  grpc::EnableDefaultHealthCheckService(true);
  if (config.reflection) {
    if (auto status = OfferReflection(); !status.ok()) return status;
  }
  grpc::ServerBuilder builder;
  SetTransport(config, builder);
  auto handler = builder.experimental().AddExternalConnectionAcceptor(
      grpc::ServerBuilder::experimental_type::ExternalConnectionType::FROM_FD, impl->Credentials());
  impl->Register(builder);
  impl->server = builder.BuildAndStart();
  if (impl->server == nullptr) {
    return absl::UnavailableError("gRPC cannot start; its line above says why");
  }
  impl->acceptor = std::make_unique<Acceptor>(*std::move(listeners), std::move(handler),
                                              config.limits.max_connections);
  impl->acceptor->Start();
  impl->health = impl->server->GetHealthCheckService();
  impl->ReportHealth(true);
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

absl::Status Server::Reload() {
  if (auto status = impl_->ReadAccess(); !status.ok()) return status;
  const AccessControl& access = impl_->core.access;
  impl_->core.open_calls.EndIf(
      [&](const Caller& caller, const Peer& before, const std::string& method) {
        const absl::StatusOr<Peer> peer = access.Identify(caller);
        if (!peer.ok()) return peer.status();
        return peer->name == before.name ? CheckRole(*peer, method)
                                         : absl::UnauthenticatedError("the token was revoked");
      });
  return absl::OkStatus();
}

bool Server::Drain() {
  std::call_once(impl_->drained, [&] {
    ServerCore& core = impl_->core;
    const Clock::time_point end = Clock::now() + core.config.drain;
    core.draining = true;
    impl_->ReportHealth(false);
    const bool applied = core.ingestor.Drain(end);
    core.versions.Close();
    WaitForCalls(core, end);
    core.cancelling = true;
    core.open_calls.EndAll(DrainingError());
    if (impl_->unread) impl_->unread->SetPatience(kLastReads);
    impl_->StopListening();
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
