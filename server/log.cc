#include "server/log.h"

#include <grpc/support/log.h>

#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "clearway/planning/ompl_log.h"
#include "spdlog/sinks/base_sink.h"
#include "spdlog/sinks/stdout_color_sinks.h"
#include "spdlog/spdlog.h"

namespace clearway {
namespace {

constexpr std::uint64_t kLinesPerSecond = 50;

// Hands on what the budget allows.
class LimitedSink final : public spdlog::sinks::base_sink<std::mutex> {
 private:
  void sink_it_(const spdlog::details::log_msg& line) override {
    const LineBudget::Verdict verdict = budget_.Take(LineBudget::Clock::now());
    if (verdict.left_out > 0) {
      const std::string note =
          "the log: " + std::to_string(verdict.left_out) + " lines were left out";
      stderr_.log({line.time, {}, line.logger_name, spdlog::level::warn, note});
    }
    if (verdict.write) stderr_.log(line);
  }
  void flush_() override { stderr_.flush(); }

  LineBudget budget_{kLinesPerSecond};
  spdlog::sinks::stderr_color_sink_mt stderr_;
};

// OMPL warns of its own defaults, as of cells of a projection that an area without an extent has:
// nothing that an operator could change.
void WriteOmpl(OmplLevel level, const std::string& text) {
  const bool is_error = level == OmplLevel::kError;
  spdlog::log(is_error ? spdlog::level::warn : spdlog::level::debug, "OMPL: {}", text);
}

// Never freed: gRPC's threads may have something to say when the program's objects are gone.
spdlog::logger* logger_of_grpc = nullptr;

// gRPC's errors are about one connection each: warnings for a server.
void WriteGrpc(gpr_log_func_args* line) {
  const bool is_error = line->severity == GPR_LOG_SEVERITY_ERROR;
  const char* const slash = std::strrchr(line->file, '/');
  logger_of_grpc->log(is_error ? spdlog::level::warn : spdlog::level::debug, "gRPC: {}:{}: {}",
                      slash == nullptr ? line->file : slash + 1, line->line, line->message);
}

}  // namespace

LineBudget::Verdict LineBudget::Take(Clock::time_point now) {
  Verdict verdict;
  if (now - second_begins_ >= std::chrono::seconds(1)) {
    second_begins_ = now;
    lines_ = 0;
    verdict.left_out = std::exchange(left_out_, 0);
  }
  verdict.write = lines_ < lines_per_second_;
  ++(verdict.write ? lines_ : left_out_);
  return verdict;
}

void StartLog() {
  const auto* const logger = new std::shared_ptr<spdlog::logger>(
      std::make_shared<spdlog::logger>("clearway-server", std::make_shared<LimitedSink>()));
  spdlog::set_default_logger(*logger);
  logger_of_grpc = logger->get();
  WriteOmplLog(WriteOmpl);
  gpr_set_log_function(WriteGrpc);
}

}  // namespace clearway
