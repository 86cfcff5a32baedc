// The search for the earliest arrival over places and their safe intervals.
#pragma once

#include <absl/container/flat_hash_map.h>
#include <absl/container/flat_hash_set.h>

#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "planning/roadmap.h"
#include "planning/timed_checks.h"

namespace clearway {

// A stay at a place: reached at arrival_s, to be left until leave_by_s. `departed_s` is when the
// stay before it ended.
struct Stay {
  std::size_t place;
  double arrival_s, leave_by_s;
  int before = -1;
  double departed_s = 0;
};

// Searches a roadmap that grows between searches, and remembers what was asked. One thread.
class IntervalSearch {
 public:
  IntervalSearch(const SpaceTimeStateSpace& space, Roadmap& roadmap, TimedChecks& checks)
      : space_(space), roadmap_(roadmap), checks_(checks) {}

  struct Question {
    std::vector<std::pair<std::size_t, double>> starts;  // places and times
    std::vector<std::size_t> goals;
    // When, of a stay at that goal from one time until another, being there is what is wanted.
    std::function<std::optional<double>(std::size_t goal, double from_s, double until_s)> arrives;
    // Of what may be left of the way: above 1, greedy: sooner found and later there.
    double weight = 1;
    double earlier_than_s = std::numeric_limits<double>::infinity();
    std::size_t most_ways = std::numeric_limits<std::size_t>::max();  // to ask about
    std::function<bool()> cancelled;
  };
  // The stays of a path, in their order; empty if none was found.
  std::vector<Stay> Find(const Question& question);
  // Not before then it is worth trying to be at the place. `cancelled`, not null, if it is a goal,
  // which is looked at closely.
  double FreeFrom(std::size_t place, double arrival_s, const std::function<bool()>* cancelled);
  // See TimedChecks::LookFiner. What was found in the way before then is looked at again.
  bool LookFiner();
  // All of the last search.
  const std::vector<Stay>& stays() const { return stays_; }
  // Whether the last search left no way unasked.
  bool exhausted() const { return open_.empty(); }

 private:
  // A way out of a stay that may be worth looking at, from a time on.
  struct Candidate {
    double priority;
    int stay;
    Roadmap::Neighbor to;
    double depart_s;
    bool operator<(const Candidate& other) const { return priority > other.priority; }
  };

  void Propose(int stay, const Roadmap::Neighbor& to, double depart_s);
  // Both: whether that reached a goal.
  bool AddStay(std::size_t place, double arrival_s, int before, double departed_s);
  // Looks at the most promising candidate.
  bool Follow(const Candidate& candidate);
  // Until when the place can be held by a stay that makes this arrival needless, if there is one.
  std::optional<double> HeldUntil(std::size_t place, double arrival_s) const;
  // Until when it can be held from then on, as far as that was asked.
  std::optional<double> KnownUntil(std::size_t place, double arrival_s) const;
  double LeaveBy(std::size_t place, double arrival_s);
  void KnowPlaces();  // all of the roadmap
  // At full speed from the place to the nearest goal.
  double LeftSeconds(std::size_t place);
  const WayAnswer& Ask(std::size_t from, std::size_t to, double depart_s, double arrival_s);

  const SpaceTimeStateSpace& space_;
  Roadmap& roadmap_;
  TimedChecks& checks_;

  // Of the search at hand.
  const Question* question_ = nullptr;
  std::vector<Stay> stays_;
  std::vector<std::vector<int>> stays_at_;     // by place
  std::vector<Candidate> open_;                // a heap
  std::vector<std::optional<double>> left_s_;  // by place

  // Of all searches.
  using Way = std::pair<std::size_t, std::size_t>;
  absl::flat_hash_set<Way> never_;
  absl::flat_hash_map<std::pair<Way, std::int64_t>, WayAnswer> answers_;
  // By place: from when to when it can be held, and when something is in the way there.
  std::vector<std::vector<std::pair<double, double>>> held_;
  struct Taken {
    double from_s, until_s;
    bool closely;  // looked at
  };
  std::vector<std::vector<Taken>> taken_;
};

}  // namespace clearway
