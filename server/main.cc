// clearway-server: see --help.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "server/acceptor.h"
#include "server/config.h"
#include "server/log.h"
#include "server/memory_use.h"
#include "server/server.h"
#include "server/signals.h"
#include "server/thread_priority.h"
#include "spdlog/spdlog.h"

extern char** environ;

namespace clearway {
namespace {

constexpr int kBadUsage = 2;
constexpr int kCannotStart = 1;
constexpr int kEndedAtOnce = 3;

void Reload(Server& server, const ServerConfig& config) {
  if (config.tokens.empty() && config.tls_cert.empty()) {
    spdlog::info("SIGHUP: nothing to read again");
    return;
  }
  const absl::Status status = server.Reload();
  if (status.ok()) {
    spdlog::info("SIGHUP: tokens and certificates are read again");
  } else {
    spdlog::error("SIGHUP: nothing has changed: {}", std::string(status.message()));
  }
}

// Debian's abseil is built to look for deadlocks whenever gRPC locks something, and to abort where
// it takes something for one.
void TrustLocks() { absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore); }

int Serve(const ServerConfig& config) {
  TrustLocks();
  KeepFewArenas();
  RaiseDescriptorLimit();
  const Signals signals;
  PreferShortTurns();  // of the threads that answer; those that apply frames give way
  absl::StatusOr<std::unique_ptr<Server>> server = Server::Start(config);
  if (!server.ok()) {
    spdlog::error("{}", std::string(server.status().message()));
    return kCannotStart;
  }
  std::printf("listening on %s\n", (*server)->address().c_str());
  std::fflush(stdout);
  int signal = signals.Next();
  for (; signal == SIGHUP; signal = signals.Next()) Reload(**server, config);
  spdlog::info("signal {}: draining for up to {} s; another one ends at once", signal,
               ToSeconds(config.drain));
  signals.EndAtTheNext(kEndedAtOnce);
  if (!(*server)->Drain()) {
    spdlog::warn("drained, but for a change or clients that read nothing: leaving them");
    spdlog::shutdown();
    std::quick_exit(0);
  }
  spdlog::info("drained");
  return 0;
}

int Main(const std::vector<std::string>& arguments) {
  StartLog();
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);
  absl::StatusOr<CommandLine> line = ReadCommandLine(arguments, environment);
  if (!line.ok()) {
    spdlog::error("{}", std::string(line.status().message()));
    return kBadUsage;
  }
  spdlog::set_level(spdlog::level::from_str(line->config.log_level));
  for (const std::string& warning : line->warnings) spdlog::warn("{}", warning);
  if (!line->help.empty() || line->print_config) {
    std::fputs(line->help.empty() ? ToToml(line->config).c_str() : line->help.c_str(), stdout);
    return 0;
  }
  return Serve(line->config);
}

}  // namespace
}  // namespace clearway

int main(int argc, char** argv) { return clearway::Main({argv + 1, argv + argc}); }
