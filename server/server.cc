#include "server/server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <thread>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "server/core.h"
#include "server/pollers.h"
#include "server/services.h"
#include "server/status_interceptor.h"

namespace clearway {
namespace {

constexpr std::chrono::seconds kLastCalls(5);  // that calls still running at the end may take
constexpr std::chrono::milliseconds kLastAnswers(200);  // that open streams may take
constexpr int kSpareThreads = 64;                       // of gRPC's own, beyond one per call

absl::StatusOr<std::string> ReadPem(const char* key, const std::string& path) {
  constexpr std::uint64_t kMaxBytes = 16'000'000;
  absl::StatusOr<std::string> pem = ReadWholeFile(path, kMaxBytes);
  if (!pem.ok()) {
    return absl::Status(pem.status().code(), absl::StrCat(key, ": ", pem.status().message()));
  }
  if (pem->empty()) return absl::InvalidArgumentError(absl::StrCat(key, ": ", path, ": is empty"));
  return pem;
}

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> CredentialsOf(const ServerConfig& config) {
  if (config.tls_cert.empty()) return grpc::InsecureServerCredentials();
  absl::StatusOr<std::string> cert = ReadPem("tls_cert", config.tls_cert);
  if (!cert.ok()) return cert.status();
  absl::StatusOr<std::string> key = ReadPem("tls_key", config.tls_key);
  if (!key.ok()) return key.status();
  grpc::SslServerCredentialsOptions options;
  options.pem_key_cert_pairs.push_back({*key, *cert});
  return grpc::SslServerCredentials(options);
}

// The address with the port that was bound.
std::string BoundAddress(const std::string& listen, int port) {
  const std::size_t colon = listen.rfind(':');
  if (listen.rfind("unix:", 0) == 0 || colon == std::string::npos) return listen;
  return absl::StrCat(listen.substr(0, colon + 1), port);
}

// gRPC would take the socket away from a server that listens there.
absl::Status CheckSocketIsFree(const std::string& listen) {
  sockaddr_un address{};
  if (!listen.starts_with("unix:")) return absl::OkStatus();
  const std::string_view path = std::string_view(listen).substr(5);
  if (path.size() >= sizeof(address.sun_path)) return absl::OkStatus();  // gRPC says so itself
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, path.size());
  const int client = socket(AF_UNIX, SOCK_STREAM, 0);
  const bool answers =
      connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(client);
  if (!answers) return absl::OkStatus();
  return absl::AlreadyExistsError(absl::StrCat("listen: another server listens on ", listen));
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

// Until no call but open push streams is running; those may stay idle for ever.
void WaitForCalls(const ServerCore& core) {
  const auto end = std::chrono::steady_clock::now() + kLastCalls;
  while (core.calls > core.push_streams && std::chrono::steady_clock::now() < end) {
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
  std::string address;
  std::once_flag drained;
};

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() { Drain(); }

const std::string& Server::address() const { return impl_->address; }
ServerCore& Server::core() { return impl_->core; }

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerConfig& config) {
  absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> credentials = CredentialsOf(config);
  if (!credentials.ok()) return credentials.status();
  if (auto status = CheckSocketIsFree(config.listen); !status.ok()) return status;
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  auto impl = std::make_unique<Impl>(config);
  grpc::ServerBuilder builder;
  SetLimits(config.limits, builder);
  int port = 0;
  builder.AddListeningPort(config.listen, *credentials, &port);
  for (grpc::Service* service : std::initializer_list<grpc::Service*>{
           &impl->check, &impl->follow, &impl->ingest, &impl->lease, &impl->map, &impl->object,
           &impl->occupancy, &impl->plan, &impl->info}) {
    builder.RegisterService(service);
  }
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> interceptors;
  interceptors.push_back(MakeStatusInterceptor());
  builder.experimental().SetInterceptorCreators(std::move(interceptors));
  impl->server = builder.BuildAndStart();
  if (impl->server == nullptr || port == 0) {
    return absl::AlreadyExistsError(
        absl::StrCat("listen: cannot listen on ", config.listen,
                     "; is the address in use, or the socket's folder missing?"));
  }
  impl->address = BoundAddress(config.listen, port);
  impl->server->GetHealthCheckService()->SetServingStatus(true);
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

void Server::Drain() {
  std::call_once(impl_->drained, [&] {
    impl_->core.draining = true;
    impl_->server->GetHealthCheckService()->SetServingStatus(false);
    impl_->core.ingestor.Drain();
    impl_->core.versions.Close();
    WaitForCalls(impl_->core);
    impl_->server->Shutdown(std::chrono::system_clock::now() + kLastAnswers);
    impl_->server->Wait();
  });
}

}  // namespace clearway
