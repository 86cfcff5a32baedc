// A mirror: what one scan of a real drive costs to follow, how far the mirror lags behind, and
// checks in it against checks on the server's own scene.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "clearway/client/scene_mirror.h"
#include "clearway/collision/scene_checker.h"
#include "clearway/scene/scene_delta.h"
#include "drive_server.h"
#include "load/load.h"
#include "summary.h"
#include "wire/delta_wire.h"

namespace clearway::bench {
namespace {

using Clock = std::chrono::steady_clock;

double MsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

// What one version costs to follow.
struct FollowCost {
  double bytes = 0, make_ms = 0, apply_ms = 0;
};

// Sends `next` to a mirror that has `before`, without the network.
FollowCost FollowOnce(const SceneSnapshot& before, const SceneSnapshot& next) {
  FollowCost cost;
  std::vector<v1::SceneDeltaPart> parts;
  Clock::time_point begin = Clock::now();
  WriteDifference(SceneDifference(&before, next), [&](const v1::SceneDeltaPart& part) {
    parts.push_back(part);
    return true;
  });
  cost.make_ms = MsSince(begin);
  begin = Clock::now();
  DeltaAssembler assembler;
  std::optional<SceneDelta> delta;
  for (const v1::SceneDeltaPart& part : parts) {
    delta = *assembler.Add(part);
    cost.bytes += static_cast<double>(part.ByteSizeLong());
  }
  const auto mirrored = Apply(&before, *delta);
  cost.apply_ms = MsSince(begin);
  if (!mirrored.ok() || !SameContent(*mirrored, next)) std::abort();
  return cost;
}

// Each scan's delta, but for the first few scans: they fill an empty map.
void Deltas(benchmark::State& state, Drive drive, std::size_t scans) {
  constexpr std::size_t kFirst = 3;
  ThreadPool pool(1);
  for (auto _ : state) {
    SceneBuilder builder(DriveParams(), {}, pool);
    ScenePtr before;
    FollowCost sum;
    for (std::size_t i = 0; i < scans; ++i) {
      if (!builder.Apply(drive.Next()).ok()) state.SkipWithError("a scan was refused");
      const ScenePtr next = builder.Publish();
      if (i >= kFirst) {
        const FollowCost cost = FollowOnce(*before, *next);
        sum.bytes += cost.bytes;
        sum.make_ms += cost.make_ms;
        sum.apply_ms += cost.apply_ms;
      }
      before = next;
    }
    const double counted = static_cast<double>(scans - kFirst);
    state.counters["delta_mb_per_scan"] = sum.bytes / 1e6 / counted;
    state.counters["delta_make_ms"] = sum.make_ms / counted;
    state.counters["delta_apply_ms"] = sum.apply_ms / counted;
  }
}

std::unique_ptr<SceneMirror> Follow(const DriveServer& served) {
  auto mirror = SceneMirror::Follow(*Connection::Open(served.address()));
  if (!mirror.ok()) std::abort();
  return *std::move(mirror);
}

// From the answer to an applied scan to its appearance in a mirror, over loopback.
void Lag(benchmark::State& state, std::size_t scans) {
  DriveServer served(1);
  const auto mirror = Follow(served);
  for (auto _ : state) {
    std::vector<double> lags_ms;
    for (std::size_t i = 0; i < scans; ++i) {
      const std::uint64_t version = served.Apply();
      const Clock::time_point begin = Clock::now();
      const auto shown = mirror->WaitFor(version, std::chrono::seconds(10));
      if (!shown.ok()) state.SkipWithError("the mirror lost the server");
      lags_ms.push_back(MsSince(begin));
    }
    std::sort(lags_ms.begin(), lags_ms.end());
    state.counters["mirror_lag_ms"] = lags_ms[lags_ms.size() / 2];
  }
}

LoadCall ChecksIn(const ScenePtr& scene, const std::vector<StateBatch>& batches) {
  const auto robot =
      std::make_shared<const PreparedRobot>(Robot::SingleShape("robot", Box{{1.0, 0.7, 1.0}}));
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  const auto checker = std::make_shared<SceneChecker>(scene, robot);
  return [checker, options, &batches, next = std::size_t{0}]() mutable {
    return checker->Check(batches[next++ % batches.size()], options).status();
  };
}

// The same states on the server's own scene and on a mirror's copy of it, by turns: checks per
// second there over here.
double ChecksInMirrorVsLocal(benchmark::State& state, DriveServer& served, const ScenePtr& copy,
                             Duration turn) {
  if (!SameContent(*copy, *served.Newest())) state.SkipWithError("the mirror differs");
  RandomQuestions questions(served.GroundSpace(), 1);
  std::vector<StateBatch> batches;
  for (int i = 0; i < 8; ++i) batches.push_back(questions.States(1'000, {Pose{}}));
  const std::vector<LoadCall> local = {ChecksIn(served.Newest(), batches)};
  const std::vector<LoadCall> mirrored = {ChecksIn(copy, batches)};
  constexpr int kTurns = 8;  // short ones: what disturbs one side disturbs the other
  double in_process = 0, in_mirror = 0;
  for (int i = 0; i < kTurns; ++i) {
    in_process += RunLoad(local, turn / 2)->CallsPerSecond();
    in_mirror += RunLoad(mirrored, turn / 2)->CallsPerSecond();
  }
  return in_mirror / in_process;
}

// In a mirror that was just synchronized.
void Checks(benchmark::State& state, DriveServer& served, Duration turn) {
  const auto mirror = Follow(served);
  for (auto _ : state) {
    state.counters["mirror_vs_local_x"] =
        ChecksInMirrorVsLocal(state, served, mirror->Latest(), turn);
  }
}

// In one that has followed so many scans since, one by one.
void FollowedChecks(benchmark::State& state, DriveServer& served, std::size_t scans,
                    Duration turn) {
  const auto mirror = Follow(served);
  for (std::size_t i = 0; i < scans; ++i) {
    if (!mirror->WaitFor(served.Apply(), std::chrono::seconds(10)).ok()) {
      return state.SkipWithError("the mirror lost the server");
    }
  }
  for (auto _ : state) {
    state.counters["mirror_following_vs_local_x"] =
        ChecksInMirrorVsLocal(state, served, mirror->Latest(), turn);
  }
}

void Register(const Effort& effort) {
  const std::size_t scans = effort.quick ? 6 : 20;
  const auto served = std::make_shared<DriveServer>(scans);
  const Duration turn = std::chrono::milliseconds(effort.quick ? 500 : 2000);
  using State = benchmark::State;
  // First: a mirror lives in a planner's process, whose memory is not what other scenes left over.
  Add("checks", effort, [=](State& s) { Checks(s, *served, turn); });
  Add("checks_following", effort, [=](State& s) { FollowedChecks(s, *served, scans, turn); });
  Add("deltas", effort, [=, drive = Drive()](State& s) { Deltas(s, drive, scans); });
  Add("lag", effort, [=](State& s) { Lag(s, scans); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
