#include "clearway/planning/ompl_log.h"

#include <ompl/util/Console.h>

#include <utility>

namespace clearway {
namespace {

using Write = std::function<void(OmplLevel level, const std::string& text)>;

class Handler : public ompl::msg::OutputHandler {
 public:
  explicit Handler(Write write) : write_(std::move(write)) {}

  void log(const std::string& text, ompl::msg::LogLevel level, const char*, int) override {
    write_(level >= ompl::msg::LOG_ERROR  ? OmplLevel::kError
           : level >= ompl::msg::LOG_WARN ? OmplLevel::kWarning
           : level >= ompl::msg::LOG_INFO ? OmplLevel::kInfo
                                          : OmplLevel::kDebug,
           text);
  }

 private:
  const Write write_;
};

}  // namespace

void WriteOmplLog(Write write) {
  // OMPL keeps the pointer for as long as the process runs.
  ompl::msg::useOutputHandler(new Handler(std::move(write)));
}

}  // namespace clearway
