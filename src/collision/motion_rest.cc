#include "clearway/collision/motion_rest.h"

#include <algorithm>

#include "collision/link_motion.h"

namespace clearway {
namespace {

// Appends knots [first, last) of a batch to another.
void AppendKnots(const MotionBatch& from, std::size_t links, std::size_t first, std::size_t last,
                 MotionBatch& to) {
  const auto part = [](auto& values, std::size_t begin, std::size_t end, auto& added) {
    added.insert(added.end(), values.begin() + static_cast<std::ptrdiff_t>(begin),
                 values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  part(from.times, first, last, to.times);
  part(from.T_W_L, first * links, last * links, to.T_W_L);
  if (!from.deviations_m.empty()) {
    part(from.deviations_m, first * links, last * links, to.deviations_m);
  }
}

// Appends the place at `now` between the knots `before` and the next. The links may stray as far
// from the rest of the way as from all of it.
void AppendPlace(const MotionBatch& from, std::size_t links, std::size_t before, Time now,
                 MotionBatch& to) {
  const double lasts_s = ToSeconds(from.times[before + 1] - from.times[before]);
  const double share = ToSeconds(now - from.times[before]) / lasts_s;
  to.times.push_back(now);
  for (std::size_t i = before * links; i < (before + 1) * links; ++i) {
    to.T_W_L.push_back(LinkMotion(from.T_W_L[i], from.T_W_L[i + links], lasts_s).At(share));
    if (!from.deviations_m.empty()) to.deviations_m.push_back(from.deviations_m[i]);
  }
}

}  // namespace

MotionRest RestOf(const MotionBatch& motions, std::size_t links, Time now) {
  MotionRest rest;
  std::size_t begin = 0;
  for (std::size_t m = 0; m < motions.knot_counts.size(); ++m) {
    const std::size_t end = begin + motions.knot_counts[m];
    const auto first = motions.times.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = motions.times.begin() + static_cast<std::ptrdiff_t>(end);
    const auto next = std::upper_bound(first, last, now);  // the first knot that is to come
    if (next != last) {
      const auto knot = static_cast<std::size_t>(next - motions.times.begin());
      const bool under_way = knot > begin;
      if (under_way) AppendPlace(motions, links, knot - 1, now, rest.motions);
      AppendKnots(motions, links, knot, end, rest.motions);
      rest.motions.knot_counts.push_back(end - knot + (under_way ? 1 : 0));
      rest.indices.push_back(m);
    }
    begin = end;
  }
  return rest;
}

}  // namespace clearway
