#include "clearway/collision/departure_intervals.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "collision/departing_edge.h"
#include "collision/time_window.h"

namespace clearway {
namespace {

// Of one call, about.
constexpr std::size_t kPosesAtOnce = 20'000;
// To each side, of one place.
constexpr int kLooksAside = 64;
// Departures that take a deviation above the first are not asked about at once: they are hardly
// ever free, and take a look at much of the map. Above the other it is not valid.
constexpr double kHardlyFree_m = 1, kMostDeviation_m = 1e5;

absl::Status Invalid(const std::string& field, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(field, " ", what));
}

// Of all departures and knots.
absl::Status CheckTimes(const MotionBatch& edges, const TimeInterval& window) {
  for (const Time knot : edges.times) {
    for (const Time departure : {window.from, window.until}) {
      const std::int64_t half = ToNanoseconds(knot) / 2 + ToNanoseconds(departure) / 2;
      if (half < kFarthest_ns / 2 && half > -kFarthest_ns / 2) continue;
      return Invalid("window", absl::StrCat("has departures from which a knot of ",
                                            ToNanoseconds(knot), " lies beyond ", kFarthest_ns));
    }
  }
  return absl::OkStatus();
}

absl::Status Validate(const MotionBatch& edges, const Robot& robot, const TimeInterval& window,
                      const DepartureIntervalOptions& options) {
  if (auto status = Validate(options.motion, robot); !status.ok()) return status;
  if (options.motion.world_at) return Invalid("world_at_ns", "is not for departures: time passes");
  if (auto status = Validate(edges, robot); !status.ok()) return status;
  if (auto status = ValidateWindow(window, "resolution_ns", options.resolution); !status.ok()) {
    return status;
  }
  return CheckTimes(edges, window);
}

// Sorts them and joins those that touch.
std::vector<TimeInterval> Joined(std::vector<TimeInterval> parts) {
  std::ranges::sort(parts, std::less<>(), &TimeInterval::from);
  std::vector<TimeInterval> joined;
  for (const TimeInterval& part : parts) {
    if (joined.empty() || joined.back().until < part.from) {
      joined.push_back(part);
    } else {
      joined.back().until = std::max(joined.back().until, part.until);
    }
  }
  return joined;
}

// Halves intervals of departures until they are proved free or too short. Where the middle
// departure is in contact, looks at the same place tell cheaply which others are.
class Search {
 public:
  Search(const StateChecker& checker, const MotionBatch& edges, const TimeInterval& window,
         const DepartureIntervalOptions& options)
      : checker_(checker), options_(options), free_(edges.knot_counts.size()) {
    const std::vector<double> reaches_m = LinkReaches(checker.robot());
    std::size_t knot = 0;
    for (std::size_t e = 0; e < edges.knot_counts.size(); ++e) {
      edges_.emplace_back(edges, knot, knot + edges.knot_counts[e], reaches_m);
      knot += edges.knot_counts[e];
      open_.push_back({e, window, Time::min()});
    }
    never_.resize(edges_.size());
  }

  absl::StatusOr<std::vector<std::vector<TimeInterval>>> Run() {
    while (!open_.empty()) {
      if (auto status = Ask(); !status.ok()) return status;
      if (auto status = Look(); !status.ok()) return status;
    }
    for (auto& parts : free_) parts = Joined(std::move(parts));
    return std::move(free_);
  }

 private:
  struct Open {
    std::size_t edge;
    TimeInterval departures;
    // Whoever departs in them is free up to this time, so that it need not be proved again.
    Time free_until;

    Duration length() const { return departures.until - departures.from; }
  };
  struct Asked {
    Open open;
    bool all;  // not only the middle
  };
  struct Blocked {
    Open open;
    Duration since_departure;  // the middle one is in contact then
  };

  // About the last of those that are open: so there are never many.
  absl::Status Ask() {
    MotionBatch motions;
    std::vector<Asked> asked;
    while (!open_.empty() && motions.T_W_L.size() < kPosesAtOnce) {
      const Open next = open_.back();
      open_.pop_back();
      if (!never_[next.edge]) Append(next, motions, asked);
    }
    const auto reply = checker_.CheckMotions(motions, options_.motion);
    if (!reply.ok()) return reply.status();
    auto answer = reply->answers.begin();
    for (const Asked& a : asked) {
      const MotionAnswer& middle = *answer++;
      Take(a.open, middle, a.all ? &*answer++ : nullptr);
    }
    return absl::OkStatus();
  }

  void Append(const Open& open, MotionBatch& motions, std::vector<Asked>& asked) {
    const DepartingEdge& edge = edges_[open.edge];
    if (open.free_until > edge.ArrivalAfter(open.departures.until)) {
      free_[open.edge].push_back(open.departures);
      return;
    }
    const Time middle = MiddleOf(open.departures);
    const double most_m = open.length() > options_.resolution ? kHardlyFree_m : kMostDeviation_m;
    asked.push_back({open, edge.MostDeviation(open.departures) <= most_m});
    edge.AppendMotion({middle, middle}, open.free_until, motions);
    if (asked.back().all) edge.AppendMotion(open.departures, open.free_until, motions);
  }

  // all: null if it was not asked about.
  void Take(Open open, const MotionAnswer& middle, const MotionAnswer* all) {
    if (all != nullptr && all->status == SpaceStatus::kFree) {
      free_[open.edge].push_back(open.departures);
      return;
    }
    if (all != nullptr) open.free_until = std::max(open.free_until, all->free_until);
    if (middle.witness && middle.witness->object == kStaticLabel) {
      never_[open.edge] = true;  // what stands still is in the way whenever the robot departs
    } else if (open.length() > options_.resolution) {
      const Time m = MiddleOf(open.departures);
      if (middle.witness) {
        blocked_.push_back({open, middle.witness->until - m});
      } else {
        open_.push_back({open.edge, {m, open.departures.until}, open.free_until});
        open_.push_back({open.edge, {open.departures.from, m}, open.free_until});
      }
    }
  }

  // Departures about the middle, as far apart as the resolution.
  std::vector<Time> LooksAround(const TimeInterval& departures) const {
    const Time middle = MiddleOf(departures);
    std::vector<Time> looks{middle};
    for (int i = 0; i < kLooksAside && looks.back() > departures.from; ++i) {
      looks.push_back(std::max(departures.from, looks.back() - options_.resolution));
    }
    std::ranges::reverse(looks);
    for (int i = 0; i < kLooksAside && looks.back() < departures.until; ++i) {
      looks.push_back(std::min(departures.until, looks.back() + options_.resolution));
    }
    return looks;
  }

  // What is around blocked departures: where the robot that departs in the middle is in contact,
  // others will be.
  absl::Status Look() {
    StateBatch states;
    for (const Blocked& b : blocked_) {
      for (const Time departure : LooksAround(b.open.departures)) {
        states.times.push_back(departure + b.since_departure);
        edges_[b.open.edge].AppendPlace(b.since_departure, states.T_W_L);
      }
    }
    if (blocked_.empty()) return absl::OkStatus();
    const auto reply = checker_.Check(states, options_.motion.check);
    if (!reply.ok()) return reply.status();
    auto answer = reply->answers.begin();
    for (const Blocked& b : blocked_) {
      std::vector<Departure> looks{{b.open.departures.from, false}};
      for (const Time departure : LooksAround(b.open.departures)) {
        looks.push_back({departure, answer++->status != SpaceStatus::kFree});
      }
      looks.push_back({b.open.departures.until, false});
      PushRest(b.open, looks);
    }
    blocked_.clear();
    return absl::OkStatus();
  }

  struct Departure {
    Time at;
    bool blocked;
  };
  // Opens what is not between two that are blocked, cut at the middle.
  void PushRest(const Open& open, const std::vector<Departure>& looks) {
    const Time middle = MiddleOf(open.departures);
    Time from = open.departures.from;
    for (std::size_t i = 0; i + 1 < looks.size(); ++i) {
      const Time at = looks[i].at, next = looks[i + 1].at;
      if (looks[i].blocked && looks[i + 1].blocked) from = next;
      const bool ends = next == middle || next == open.departures.until ||
                        (looks[i + 1].blocked && looks[i + 2].blocked);
      if (!ends || from >= next || at == next) continue;
      open_.push_back({open.edge, {from, next}, open.free_until});
      from = next;
    }
  }

  const StateChecker& checker_;
  const DepartureIntervalOptions& options_;
  std::vector<DepartingEdge> edges_;
  std::vector<Open> open_;
  std::vector<Blocked> blocked_;
  std::vector<bool> never_;  // of each edge
  std::vector<std::vector<TimeInterval>> free_;
};

}  // namespace

absl::StatusOr<std::vector<std::vector<TimeInterval>>> FindDepartureIntervals(
    const StateChecker& checker, const MotionBatch& edges, const TimeInterval& window,
    const DepartureIntervalOptions& options) {
  if (auto status = Validate(edges, checker.robot(), window, options); !status.ok()) return status;
  return Search(checker, edges, window, options).Run();
}

}  // namespace clearway
