#include "collision/time_window.h"

#include "absl/strings/str_cat.h"
#include "collision/validation.h"

namespace clearway {
namespace {

constexpr std::int64_t kLongest_ns = std::int64_t{1} << 61, kMostSteps = 100'000;

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

}  // namespace

absl::Status ValidateWindow(const TimeInterval& window, const std::string& step_field,
                            Duration step) {
  for (const auto& [field, time] :
       {std::pair{"window.from_ns", window.from}, {"window.until_ns", window.until}}) {
    if (auto status = ValidateTime(field, time); !status.ok()) return status;
  }
  if (window.until < window.from) return Invalid("window.until_ns", "is before window.from_ns");
  // By halves: the whole may be more than an int64 holds.
  if (ToNanoseconds(window.until) / 2 - ToNanoseconds(window.from) / 2 > kLongest_ns / 2) {
    return Invalid("window.until_ns",
                   absl::StrCat("is more than ", kLongest_ns, " after window.from_ns"));
  }
  if (step <= Duration::zero()) {
    return Invalid(step_field, absl::StrCat("is ", step.count(), "; it must be above 0"));
  }
  const std::int64_t steps = (window.until - window.from) / step;
  if (steps <= kMostSteps) return absl::OkStatus();
  return Invalid("window", absl::StrCat("holds ", steps, " times ", step_field,
                                        "; it may hold at most ", kMostSteps));
}

}  // namespace clearway
