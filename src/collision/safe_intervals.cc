#include "clearway/collision/safe_intervals.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"

namespace clearway {
namespace {

constexpr std::int64_t kLooksAtOnce = 32, kMostLooks = 100'000;

absl::Status Validate(std::size_t poses, std::size_t links, const TimeInterval& window,
                      const SafeIntervalOptions& options) {
  if (poses % links != 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("T_W_L has ", poses, " poses, no multiple of the robot's ", links, " links"));
  }
  if (options.look_every <= Duration::zero()) {
    return absl::InvalidArgumentError("look_every is not above 0");
  }
  if (window.until < window.from) {
    return absl::InvalidArgumentError("window.until is before window.from");
  }
  const std::int64_t looks = (window.until - window.from) / options.look_every;
  if (looks <= kMostLooks) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("window holds ", looks, " looks; it may hold at most ", kMostLooks));
}

// Configurations that are searched side by side, each from its own time on.
class Search {
 public:
  Search(const StateChecker& checker, const std::vector<Pose>& T_W_L, const TimeInterval& window,
         const SafeIntervalOptions& options)
      : checker_(checker),
        T_W_L_(T_W_L),
        links_(checker.robot().links.size()),
        window_(window),
        options_(options),
        intervals_(T_W_L.size() / links_) {
    for (std::size_t c = 0; c < intervals_.size(); ++c) open_.push_back({c, window.from, {}});
  }

  absl::StatusOr<std::vector<std::vector<TimeInterval>>> Run() {
    while (!open_.empty()) {
      if (auto status = Look(); !status.ok()) return status;
      if (auto status = Prove(); !status.ok()) return status;
      std::erase_if(open_, [&](const Open& o) { return o.next > window_.until; });
    }
    return std::move(intervals_);
  }

 private:
  struct Open {
    std::size_t configuration;
    Time next;                 // to look at
    std::optional<Time> free;  // a look that found nothing in the way
  };

  // At the next times of each, until one is free.
  absl::Status Look() {
    StateBatch states;
    std::vector<std::size_t> looks;
    for (const Open& o : open_) {
      looks.push_back(0);
      for (std::int64_t i = 0; i < kLooksAtOnce; ++i) {
        const Time t = o.next + i * options_.look_every;
        if (t > window_.until) break;
        ++looks.back();
        states.times.push_back(t);
        Append(o.configuration, states.T_W_L);
      }
    }
    const auto reply = checker_.Check(states, options_.check);
    if (!reply.ok()) return reply.status();
    auto answer = reply->answers.begin();
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const auto end = answer + static_cast<std::ptrdiff_t>(looks[i]);
      const auto free = std::find_if(
          answer, end, [](const StateAnswer& a) { return a.status == SpaceStatus::kFree; });
      open_[i].next += (free - answer) * options_.look_every;
      open_[i].free = free == end ? std::nullopt : std::optional(open_[i].next);
      answer = end;
    }
    return absl::OkStatus();
  }

  // How long those that are free stay so.
  absl::Status Prove() {
    MotionBatch waits;
    for (const Open& o : open_) {
      if (!o.free) continue;
      waits.knot_counts.push_back(2);
      // A motion takes some time.
      for (const Time t : {*o.free, std::max(window_.until, *o.free + Duration(1))}) {
        waits.times.push_back(t);
        Append(o.configuration, waits.T_W_L);
      }
    }
    const auto reply = checker_.CheckMotions(waits, {.check = options_.check});
    if (!reply.ok()) return reply.status();
    auto answer = reply->answers.begin();
    for (Open& o : open_) {
      if (!o.free) continue;
      const Time until = std::min(window_.until, answer->free_until);
      ++answer;
      intervals_[o.configuration].push_back({*o.free, until});
      o.next = until + options_.look_every;
    }
    return absl::OkStatus();
  }

  void Append(std::size_t configuration, std::vector<Pose>& T_W_L) const {
    const auto first = T_W_L_.begin() + static_cast<std::ptrdiff_t>(configuration * links_);
    T_W_L.insert(T_W_L.end(), first, first + static_cast<std::ptrdiff_t>(links_));
  }

  const StateChecker& checker_;
  const std::vector<Pose>& T_W_L_;
  std::size_t links_;
  TimeInterval window_;
  const SafeIntervalOptions& options_;
  std::vector<std::vector<TimeInterval>> intervals_;
  std::vector<Open> open_;
};

}  // namespace

absl::StatusOr<std::vector<std::vector<TimeInterval>>> FindSafeIntervals(
    const StateChecker& checker, const std::vector<Pose>& T_W_L, const TimeInterval& window,
    const SafeIntervalOptions& options) {
  const std::size_t links = checker.robot().links.size();
  if (auto status = Validate(T_W_L.size(), links, window, options); !status.ok()) return status;
  return Search(checker, T_W_L, window, options).Run();
}

}  // namespace clearway
