#include "closed_loop/evasion.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "closed_loop/path_proof.h"

namespace clearway::closed_loop {
namespace {

std::vector<TimedPath> WaysOut(const TimedPath::Knot& start, const Errand& errand) {
  constexpr int kDirections = 24;
  constexpr double kLengths_m[] = {0.4, 1, 2, 4};
  std::vector<TimedPath> ways{TimedPath(start.time, start.p_W)};
  for (int i = 0; i < kDirections; ++i) {
    const double angle_rad = 2 * std::numbers::pi * i / kDirections;
    for (const double length_m : kLengths_m) {
      const Eigen::Vector2d end_W =
          start.p_W + length_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad));
      if (!errand.area_W.Contains({end_W.x(), end_W.y(), 0})) continue;
      const Time arrival = start.time + FromSeconds(length_m / errand.carrier.max_speed_mps);
      ways.push_back(TimedPath({start, {arrival, end_W}}));
    }
  }
  return ways;
}

}  // namespace

Evasion FindEvasion(const StateChecker& checker, const TimedPath::Knot& start, const Errand& errand,
                    Time until, const CheckOptions& options) {
  const std::vector<TimedPath> ways = WaysOut(start, errand);
  const std::vector<Time> free_until =
      FreeUntil(checker, errand.carrier, ways, start.time, until, options);
  const auto left_m = [&](std::size_t i) { return (errand.goal_W - ways[i].end_W()).norm(); };
  std::size_t best = 0;
  for (std::size_t i = 1; i < ways.size(); ++i) {
    const bool longer = free_until[i] > free_until[best];
    const bool nearer = free_until[i] == free_until[best] && left_m(i) < left_m(best);
    if (longer || nearer) best = i;
  }
  return {ways[best], free_until[best]};
}

}  // namespace clearway::closed_loop
