#include "clearway/collision/safe_intervals.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "collision/time_window.h"

namespace clearway {
namespace {

// Of one call; so many poses take 6 MB.
constexpr std::size_t kPosesAtOnce = 100'000, kMostLooksAtOnce = 32;

absl::Status Validate(std::size_t poses, const Robot& robot, const TimeInterval& window,
                      const SafeIntervalOptions& options) {
  if (auto status = Validate(MotionOptions{.check = options.check}, robot); !status.ok()) {
    return status;
  }
  if (poses % robot.links.size() != 0) {
    return absl::InvalidArgumentError(absl::StrCat("world_from_link has ", poses,
                                                   " poses, no multiple of the robot's ",
                                                   robot.links.size(), " links"));
  }
  return ValidateWindow(window, "look_every_ns", options.look_every);
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
        look_every_(std::min(options.look_every, window.until - window.from + Duration(1))),
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
    const std::size_t looks_at_once =
        std::clamp<std::size_t>(kPosesAtOnce / (links_ * open_.size()), 1, kMostLooksAtOnce);
    StateBatch states;
    std::vector<std::size_t> looks;
    for (const Open& o : open_) {
      looks.push_back(0);
      for (std::size_t i = 0; i < looks_at_once; ++i) {
        const Time t = o.next + static_cast<std::int64_t>(i) * look_every_;
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
      open_[i].next += (free - answer) * look_every_;
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
      o.next = until + look_every_;
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
  Duration look_every_;  // no longer than it takes to leave the window
  std::vector<std::vector<TimeInterval>> intervals_;
  std::vector<Open> open_;
};

}  // namespace

absl::StatusOr<std::vector<std::vector<TimeInterval>>> FindSafeIntervals(
    const StateChecker& checker, const std::vector<Pose>& T_W_L, const TimeInterval& window,
    const SafeIntervalOptions& options) {
  if (auto status = Validate(T_W_L.size(), checker.robot(), window, options); !status.ok()) {
    return status;
  }
  return Search(checker, T_W_L, window, options).Run();
}

}  // namespace clearway
