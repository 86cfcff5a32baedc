// Departure intervals against looks at many departures and times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <type_traits>

#include "clearway/collision/departure_intervals.h"
#include "clearway/collision/scene_checker.h"
#include "collision/random_motions.h"
#include "collision/random_world.h"

namespace clearway {
namespace {

// One of a batch.
Asked OnlyOne(const Asked& edges, std::size_t first, std::size_t knots) {
  const auto part = [](const auto& values, std::size_t begin, std::size_t count) {
    return std::decay_t<decltype(values)>(
        values.begin() + static_cast<std::ptrdiff_t>(begin),
        values.begin() + static_cast<std::ptrdiff_t>(begin + count));
  };
  const MotionBatch& all = edges.motions;
  const std::size_t poses = knots * edges.links;
  Asked one{
      {{knots}, part(all.times, first, knots), part(all.T_W_L, first * edges.links, poses), {}},
      edges.links};
  if (!all.deviations_m.empty()) {
    one.motions.deviations_m = part(all.deviations_m, first * edges.links, poses);
  }
  return one;
}

Asked Departing(Asked edges, Time departure) {
  for (Time& t : edges.motions.times) t += departure.time_since_epoch();
  return edges;
}

// Of one motion at any times, each link anywhere that it may stray to.
StateBatch StrayedStates(RandomWorld& random, const Asked& edge, int count) {
  const std::vector<Time>& knots = edge.motions.times;
  std::vector<Time> times{knots.front(), knots.back()};
  const double lasts_s = ToSeconds(knots.back() - knots.front());
  while (static_cast<int>(times.size()) < count) {
    times.push_back(knots.front() + FromSeconds(random.Uniform(0, 1) * lasts_s));
  }
  StateBatch states = StatesAt(edge, 0, knots.size(), times);
  for (std::size_t i = 0; i < times.size() && !edge.motions.deviations_m.empty(); ++i) {
    std::size_t k = 0;
    while (k + 2 < knots.size() && knots[k + 1] <= times[i]) ++k;
    for (std::size_t l = 0; l < edge.links; ++l) {
      const Eigen::Vector3d any = random.Point({{-1, -1, -1}, {1, 1, 1}});
      states.T_W_L[i * edge.links + l].translation +=
          0.999 * edge.motions.deviations_m[k * edge.links + l] * any.normalized();
    }
  }
  return states;
}

struct Tried {
  int intervals = 0, departures = 0, in_contact = 0;
  double free_s = 0, found_s = 0;  // in all: of departures that are free each by itself
};

// Edges from Time() on; links of every third world stray.
Asked RandomEdges(RandomWorld& random, const Robot& robot, int count, bool stray) {
  Asked edges = RandomMotions(random, robot, count);
  std::size_t knot = 0;
  for (const std::size_t knots : edges.motions.knot_counts) {
    const Duration begins = edges.motions.times[knot].time_since_epoch();
    for (std::size_t k = 0; k < knots; ++k) edges.motions.times[knot++] -= begins;
  }
  for (std::size_t i = 0; stray && i < edges.motions.T_W_L.size(); ++i) {
    edges.motions.deviations_m.push_back(random.Uniform(0, 0.05));
  }
  return edges;
}

// Departures at both ends of the interval and between them: at many times, and whether contact can
// be found.
void TryInterval(RandomWorld& random, const SceneChecker& checker, const Asked& edge,
                 const TimeInterval& interval, const MotionOptions& options, Tried& tried) {
  ++tried.intervals;
  const double lasts_s = ToSeconds(interval.until - interval.from);
  for (int i = 0; i < 12; ++i) {
    const double share = i < 2 ? i : random.Uniform(0, 1);
    const Time departure = std::min(interval.until, interval.from + FromSeconds(share * lasts_s));
    Asked departing = Departing(edge, departure);
    const auto looks = checker.Check(StrayedStates(random, departing, 100), options.check);
    departing.motions.deviations_m.clear();
    const auto proof = checker.CheckMotions(departing.motions, options);
    tried.in_contact += proof->answers[0].witness.has_value() ||
                        std::ranges::any_of(looks->answers, [](const StateAnswer& a) {
                          return a.status != SpaceStatus::kFree;
                        });
    ++tried.departures;
  }
}

// Each departure of many by itself.
void CountFound(const SceneChecker& checker, const Asked& edges, const TimeInterval& window,
                const MotionOptions& options,
                const std::vector<std::vector<TimeInterval>>& intervals, Tried& tried) {
  constexpr double kStep_s = 0.05;
  for (Time d = window.from; d <= window.until; d += FromSeconds(kStep_s)) {
    const auto truth = checker.CheckMotions(Departing(edges, d).motions, options);
    for (std::size_t e = 0; e < edges.count(); ++e) {
      if (truth->answers[e].status != SpaceStatus::kFree) continue;
      const bool found = std::ranges::any_of(intervals[e], [&](const TimeInterval& interval) {
        return interval.from <= d && d <= interval.until;
      });
      tried.free_s += kStep_s;
      tried.found_s += found ? kStep_s : 0;
    }
  }
}

TEST(RandomDepartureIntervals, AreFreeThroughoutAndMissLittle) {
  Tried tried;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    RandomWorld random(7000 + seed);
    const ScenePtr scene = random.Scene();
    const Robot small{"small",
                      {{"body", {{Box{{0.1, 0.2, 0.1}}, Pose::Translation(0.1, 0, 0)}}},
                       {"hand", {{Capsule{0.03, 0.2}, Pose{}}, {Sphere{0.05}, Pose{}}}}}};
    const SceneChecker checker(scene, seed % 3 == 0 ? random.AnyRobot() : small);
    const Asked edges = RandomEdges(random, checker.robot(), 8, seed % 2 == 0);
    MotionOptions options = RandomMotionOptions(random, checker.robot());
    if (seed % 4 != 0) options.check.unknown = UnknownPolicy::kFree;
    const TimeInterval window{scene->stamp - FromSeconds(0.5), scene->stamp + FromSeconds(2.5)};
    const auto dut =
        FindDepartureIntervals(checker, edges.motions, window, {options, FromSeconds(0.02)});
    ASSERT_TRUE(dut.ok()) << dut.status();
    ASSERT_EQ(dut->size(), edges.count());
    std::size_t first = 0;
    for (std::size_t e = 0; e < edges.count(); ++e) {
      const std::size_t knots = edges.motions.knot_counts[e];
      const std::vector<TimeInterval>& intervals = (*dut)[e];
      for (std::size_t i = 0; i < intervals.size(); ++i) {
        EXPECT_TRUE(i == 0 || intervals[i].from > intervals[i - 1].until);
        EXPECT_TRUE(window.from <= intervals[i].from && intervals[i].until <= window.until);
        TryInterval(random, checker, OnlyOne(edges, first, knots), intervals[i], options, tried);
      }
      first += knots;
    }
    CountFound(checker, edges, window, options, *dut, tried);
  }
  EXPECT_EQ(tried.in_contact, 0) << "of " << tried.departures;
  EXPECT_GT(tried.intervals, 40);
  EXPECT_GT(tried.found_s, 0.9 * tried.free_s) << tried.found_s << " of " << tried.free_s;
  std::printf("%d intervals, %d departures, found %.1f of %.1f s\n", tried.intervals,
              tried.departures, tried.found_s, tried.free_s);
}

}  // namespace
}  // namespace clearway
