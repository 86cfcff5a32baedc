// A robot in the loop with what it sees: seeded worlds of 30 s of simulated time, in which it
// drives to a goal among moving objects and stays there, replanning at 2 Hz on the newest scene.
// What is counted does not depend on the machine's speed, and each world runs once.
//
// steady: objects keep their motion, SLAM is exact. turning: objects turn, stop and start again,
// without and with inflation. noise: SLAM of Table I, likewise. both: turning with that noise.
#include <algorithm>
#include <memory>
#include <string>

#include "closed_loop/loop.h"
#include "summary.h"

namespace clearway::bench {
namespace {

using closed_loop::Collision;
using closed_loop::Traffic;

struct Tally {
  double worlds = 0, arrived = 0;
  // With objects first seen a second before and earlier, with those seen later, and with walls.
  double collisions = 0, late_collisions = 0, static_collisions = 0;

  double GoalFraction() const { return arrived / worlds; }
};

struct Worlds {
  int count;
  Traffic traffic;
  bool slam_noise;
};

Tally Drive(const Worlds& worlds, bool inflation, benchmark::State& state) {
  Tally tally;
  for (int i = 1; i <= worlds.count; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    closed_loop::OwnScene scene;
    const auto result = closed_loop::RunLoop(
        closed_loop::MakeCourse(seed, worlds.traffic),
        closed_loop::MakeLoopOptions(worlds.slam_noise, inflation, seed), scene);
    if (!result.ok()) {
      state.SkipWithError(result.status().ToString().c_str());
      return tally;
    }
    ++tally.worlds;
    tally.arrived += result->arrival.has_value();
    for (const Collision& collision : result->collisions) {
      if (collision.object == kStaticLabel) {
        ++tally.static_collisions;
      } else {
        ++(collision.InTime() ? tally.collisions : tally.late_collisions);
      }
    }
  }
  return tally;
}

void Count(const std::string& prefix, const std::string& suffix, const Tally& tally,
           benchmark::State& state) {
  const auto set = [&](const std::string& name, double value) {
    state.counters[prefix + name + suffix] = value;
  };
  set("collisions", tally.collisions);
  set("late_collisions", tally.late_collisions);
  set("static_collisions", tally.static_collisions);
  set("goal_fraction", tally.GoalFraction());
}

void Steady(benchmark::State& state, int count) {
  for (auto _ : state) {
    Count("closed_loop_", "", Drive({count, Traffic::kSteady, false}, true, state), state);
  }
}

// What inflation brings. A plain value.
struct Gain {
  double fewer_x, goal_ratio;
};

Gain Compare(const std::string& prefix, const Worlds& worlds, benchmark::State& state) {
  const Tally without = Drive(worlds, false, state), with = Drive(worlds, true, state);
  Count(prefix, "_without", without, state);
  Count(prefix, "_with", with, state);
  const Gain gain{without.collisions / std::max(1.0, with.collisions),
                  with.GoalFraction() / without.GoalFraction()};
  state.counters[prefix + "fewer_x"] = gain.fewer_x;
  state.counters[prefix + "goal_ratio"] = gain.goal_ratio;
  return gain;
}

// Of turning objects and of noise, each on its own, the smaller gain counts.
void Inflation(benchmark::State& state, int turning, int noisy) {
  for (auto _ : state) {
    const Gain a = Compare("closed_loop_turning_", {turning, Traffic::kTurning, false}, state);
    const Gain b = Compare("closed_loop_noise_", {noisy, Traffic::kSteady, true}, state);
    state.counters["closed_loop_inflation_fewer_x"] = std::min(a.fewer_x, b.fewer_x);
    state.counters["closed_loop_inflation_goal_ratio"] = std::min(a.goal_ratio, b.goal_ratio);
  }
}

void Both(benchmark::State& state, int count) {
  for (auto _ : state) Compare("closed_loop_both_", {count, Traffic::kTurning, true}, state);
}

void Register(const Effort& effort) {
  const bool quick = effort.quick;
  const Effort once{quick, 1};
  Add("closed_loop_steady", once, [=](auto& state) { Steady(state, quick ? 20 : 200); });
  Add("closed_loop_inflation", once,
      [=](auto& state) { Inflation(state, quick ? 8 : 320, quick ? 8 : 240); });
  Add("closed_loop_both", once, [=](auto& state) { Both(state, quick ? 4 : 40); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
