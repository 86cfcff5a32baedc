// clearway-server: see --help.
#include <pthread.h>
#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "clearway/planning/ompl_log.h"
#include "server/config.h"
#include "server/memory_use.h"
#include "server/server.h"
#include "server/thread_priority.h"
#include "spdlog/sinks/stdout_color_sinks.h"
#include "spdlog/spdlog.h"

extern char** environ;

namespace clearway {
namespace {

constexpr int kBadUsage = 2;
constexpr int kCannotStart = 1;

// SIGTERM and SIGINT are waited for, in one place; threads started later inherit the mask.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

// OMPL warns of its own defaults, as of cells of a projection that an area without an extent has:
// nothing that an operator could change.
void ToLog(OmplLevel level, const std::string& text) {
  const bool is_error = level == OmplLevel::kError;
  spdlog::log(is_error ? spdlog::level::warn : spdlog::level::debug, "OMPL: {}", text);
}

int Serve(const ServerConfig& config) {
  KeepFewArenas();
  const sigset_t signals = BlockSignals();
  PreferShortTurns();  // of the threads that answer; those that apply frames give way
  absl::StatusOr<std::unique_ptr<Server>> server = Server::Start(config);
  if (!server.ok()) {
    spdlog::error("{}", std::string(server.status().message()));
    return kCannotStart;
  }
  std::printf("listening on %s\n", (*server)->address().c_str());
  std::fflush(stdout);
  int signal = 0;
  sigwait(&signals, &signal);
  spdlog::info("signal {}: draining", signal);
  if (!(*server)->Drain()) {
    spdlog::warn("drained; leaving connections whose clients read nothing");
    spdlog::shutdown();
    std::quick_exit(0);
  }
  spdlog::info("drained");
  return 0;
}

int Main(const std::vector<std::string>& arguments) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("clearway-server"));
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);
  absl::StatusOr<CommandLine> line = ReadCommandLine(arguments, environment);
  if (!line.ok()) {
    spdlog::error("{}", std::string(line.status().message()));
    return kBadUsage;
  }
  spdlog::set_level(spdlog::level::from_str(line->config.log_level));
  WriteOmplLog(ToLog);
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
