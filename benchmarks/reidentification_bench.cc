// How many of the objects that are lost out of sight and come back under new ids are known again,
// and whether one is ever taken for another: in twenty simulated worlds, exact and with the errors
// of the paper's Table I; in twenty more, of people in file who look alike; in sixty where one of
// another shape comes out in its place, near and far off; and on the real drive, where objects are
// hidden for a while at random.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "clearway/io/lidar_folder.h"
#include "clearway/report/identity_score.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/forgetful_tracker.h"
#include "clearway/sim/scenarios.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

constexpr Duration kMemory = std::chrono::milliseconds(500);

SceneParams Params() {
  SceneParams params;
  params.rays.max_range_m = 50;
  params.motion = MotionModel::kTrack;
  params.reidentify = true;
  return params;
}

// `change` is what becomes of a frame before the tracker sees it.
Identities IdentitiesIn(const FrameSource& frames, const SceneParams& params,
                        const std::function<void(Frame&)>& change) {
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  ForgetfulTracker tracker(kMemory);
  IdentityScore score;
  for (std::size_t k = 0; k < frames.frame_count; ++k) {
    auto frame = frames.read(k);
    if (!frame.ok()) std::abort();
    change(*frame);
    const Frame told = tracker.Retold(*std::move(frame));
    if (!builder.Apply(told).ok()) std::abort();
    score.Add(told, *builder.Publish(), tracker.true_ids());
  }
  return score.Result();
}

void Count(const Identities& found, const std::string& suffix, benchmark::State& state) {
  state.counters["reidentified_came_back" + suffix] = static_cast<double>(found.came_back);
  state.counters["reidentified_fraction" + suffix] =
      static_cast<double>(found.known_again) / static_cast<double>(found.came_back);
  state.counters["reidentified_wrong" + suffix] = static_cast<double>(found.wrong);
}

// The scenario's worlds of the first so many seeds.
struct Simulations {
  std::string scenario = "occlusions";
  std::uint64_t count;
  SlamNoise noise = {};
};

void InSimulations(const Simulations& worlds, const std::string& suffix, benchmark::State& state) {
  SceneParams params = Params();
  params.object_pose_error_m = worlds.noise.object.mean_translation_m;
  params.object_pose_error_rad = worlds.noise.object.mean_rotation_rad;
  Identities all;
  for (std::uint64_t seed = 1; seed <= worlds.count; ++seed) {
    const auto simulation = MakeScenario(worlds.scenario, {.seed = seed, .noise = worlds.noise});
    all += IdentitiesIn(simulation->Frames(), params, [](Frame&) {});
  }
  Count(all, suffix, state);
}

// Takes each object out of frames for 0.7 to 3 s at a time, and shows it for 1.5 to 3.5 s between.
class Hider {
 public:
  explicit Hider(unsigned seed) : random_(seed) {}

  void Hide(Frame& frame) {
    for (ObjectId& label : frame.labels) {
      if (label > kStaticLabel && Hidden(label, frame.stamp)) label = kIgnoreLabel;
    }
  }

 private:
  struct Phase {
    Time end;
    bool hidden = false;
  };

  bool Hidden(ObjectId id, Time stamp) {
    const auto [entry, is_new] = phases_.try_emplace(id);
    Phase& phase = entry->second;
    if (is_new) phase.end = stamp + Between(1.5, 3.5);
    if (stamp > phase.end) {
      phase.hidden = !phase.hidden;
      phase.end = stamp + (phase.hidden ? Between(0.7, 3.0) : Between(1.5, 3.5));
    }
    return phase.hidden;
  }
  Duration Between(double low_s, double high_s) {
    constexpr double kPerUnit = 0x1p-64;
    return FromSeconds(low_s + (high_s - low_s) * static_cast<double>(random_()) * kPerUnit);
  }

  std::mt19937_64 random_;
  std::map<ObjectId, Phase> phases_;
};

void OnTheDrive(benchmark::State& state, const std::string& path, unsigned count) {
  const auto folder = OpenLidarFolder(path, {.poses = LidarPoses::kIcp});
  if (!folder.ok()) return state.SkipWithError(folder.status().ToString().c_str());
  SceneParams params = Params();
  params.rest_distance_m = 0.6;  // as the demo's
  Identities all;
  for (unsigned seed = 1; seed <= count; ++seed) {
    Hider hider(seed);
    all += IdentitiesIn(folder->frames, params, [&](Frame& frame) { hider.Hide(frame); });
  }
  Count(all, "_drive", state);
}

void Register(const Effort& effort) {
  Effort once = effort;
  once.repetitions = 1;
  const unsigned count = effort.quick ? 2 : 20;
  const auto add = [&](const std::string& suffix, const Simulations& worlds) {
    Add("reidentification" + suffix, once, [=](auto& state) {
      for (auto _ : state) InSimulations(worlds, suffix, state);
    });
  };
  add("", {.count = count});
  add("_table1", {.count = count, .noise = SlamNoise::TableOne()});
  add("_queues", {.scenario = "queues", .count = count});
  add("_swaps", {.scenario = "swaps", .count = 3 * count});
  add("_far_swaps", {.scenario = "far_swaps", .count = 3 * count});
  const auto path = DataPath("kitti0000_fov");
  if (!path) return;  // it has said so
  Add("reidentification_drive", once, [folder = *path, count](auto& state) {
    for (auto _ : state) OnTheDrive(state, folder, count);
  });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
