// Answers about motions, tried at many times.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "collision/random_motions.h"

namespace clearway {

struct ProofCounts {
  int motions = 0, free = 0, unresolved = 0;
  int looked_at = 0;        // those of which a part was called free
  int looked_closely = 0;   // of them, at 50 times as many times
  long states = 0;          // looked at in what was called free
  int free_in_contact = 0;  // motions called free, up to some time, that are not
  int witnesses_free = 0;   // of those called in contact
};

// `count` times from `from` to `until`, most of them near those at which the robot is closest to
// anything: of a fifth of them, evenly spaced, the closest eight are looked at more finely.
inline std::vector<Time> TimesWhereItIsTight(const SceneChecker& checker, const Asked& asked,
                                             std::size_t first_knot, std::size_t knots,
                                             const CheckOptions& options, Time from, Time until,
                                             int count) {
  constexpr int kPlaces = 8;
  const int coarse = std::max(kPlaces, count / 5), fine = (count - coarse) / kPlaces;
  std::vector<Time> times;
  const auto step = (until - from) / coarse;
  for (int i = 0; i < coarse; ++i) times.push_back(from + i * step);
  CheckOptions with_clearance = options;
  with_clearance.clearance_up_to_m = 1;
  const auto reply = checker.Check(StatesAt(asked, first_knot, knots, times), with_clearance);
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, std::less<>(),
                    [&](std::size_t i) { return reply->answers[i].clearance_m.value_or(0); });
  for (int place = 0; place < kPlaces; ++place) {
    const Time middle = times[order[place]];
    for (int i = 1; i <= fine; ++i) {
      const Time t = middle - step + 2 * step * i / (fine + 1);
      times.push_back(std::clamp(t, from, until));
    }
  }
  times.back() = until;
  return times;
}

// Every motion up to where it is proved free, at `count` times, every `every`th one of them at 50
// times as many, and every witness. Of motions in contact from the start nothing is called free.
inline void TryProofs(const SceneChecker& checker, const Asked& asked, const MotionOptions& options,
                      int count, int every, ProofCounts& counts) {
  const auto reply = checker.CheckMotions(asked.motions, options);
  std::size_t first = 0;
  for (std::size_t m = 0; m < asked.count(); ++m) {
    const MotionAnswer& answer = reply->answers[m];
    const std::size_t knots = asked.motions.knot_counts[m];
    const Time from = asked.motions.times[first];
    counts.free += answer.status == SpaceStatus::kFree;
    counts.unresolved += answer.status == SpaceStatus::kUnresolved;
    if (answer.free_until > from) {
      const bool closely = counts.looked_at++ % every == 0;
      counts.looked_closely += closely;
      const int looks = closely ? 50 * count : count;
      const std::vector<Time> times = TimesWhereItIsTight(
          checker, asked, first, knots, options.check, from,
          answer.status == SpaceStatus::kFree ? answer.free_until : answer.free_until - Duration(1),
          looks);
      const auto truth = checker.Check(StatesAt(asked, first, knots, times), options.check);
      counts.states += static_cast<long>(times.size());
      counts.free_in_contact += std::ranges::any_of(
          truth->answers, [](const StateAnswer& a) { return a.status != SpaceStatus::kFree; });
    }
    if (answer.witness) {
      const auto truth =
          checker.Check(StatesAt(asked, first, knots, {answer.witness->until}), options.check);
      counts.witnesses_free += truth->answers[0].status == SpaceStatus::kFree;
    }
    ++counts.motions;
    first += knots;
  }
}

}  // namespace clearway
