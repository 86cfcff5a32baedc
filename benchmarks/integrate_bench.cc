// Scans into maps, against OctoMap's insertPointCloud with the same range: whole scans of a real
// drive into the static map (every ray, one ray per end voxel, two threads), a labelled drive with
// its moving objects, and depth images. Ours includes a frame's checks and the publication of a
// version after each scan, while a reader still holds the one before; its memory has been in use
// before, as a server's has that runs.
#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <stdexcept>

#include "clearway/scene/scene_builder.h"
#include "recorded_scans.h"
#include "summary.h"

namespace clearway::bench {
namespace {

struct Input {
  std::vector<Frame> frames;
  double resolution_m;
  double range_m;  // -1: no limit
};
using InputPtr = std::shared_ptr<const Input>;

double MapsMb(const SceneSnapshot& scene) {
  std::size_t bytes = scene.static_map_W.blocks().MemoryBytes();
  for (const auto& object : scene.objects) bytes += object->map_O.blocks().MemoryBytes();
  return static_cast<double>(bytes) / 1e6;
}

// Returns the megabytes of the pruned tree.
double Octomap(benchmark::State& state, const Input& input, bool discretize) {
  std::vector<octomap::Pointcloud> clouds;
  for (const Frame& frame : input.frames) {
    octomap::Pointcloud& cloud = clouds.emplace_back();
    for (const Eigen::Vector3f& p : PointsInWorld(frame)) cloud.push_back(p.x(), p.y(), p.z());
  }
  double memory_mb = 0;
  for (auto _ : state) {
    octomap::OcTree tree(input.resolution_m);
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      const Eigen::Vector3f origin = input.frames[i].T_W_S.translation.cast<float>();
      tree.insertPointCloud(clouds[i], {origin.x(), origin.y(), origin.z()}, input.range_m, false,
                            discretize);
    }
    state.PauseTiming();
    tree.prune();
    memory_mb = static_cast<double>(tree.memoryUsage()) / 1e6;
    state.ResumeTiming();
  }
  return memory_mb;
}

SceneParams ParamsFor(const Input& input, bool discretize) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = input.resolution_m;
  params.rays = {input.range_m, discretize};
  return params;
}

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

// Takes frames and publishes a version after each, while a reader still holds the one before.
class Integrator {
 public:
  Integrator(const SceneParams& params, int threads)
      : pool_(threads), builder_(params, {}, pool_) {}

  void Take(const Frame& frame) {
    if (!builder_.Apply(frame).ok()) throw std::runtime_error("a frame was refused");
    const auto integrated = Clock::now();
    ScenePtr published = builder_.Publish();
    publishing_ = std::max<Milliseconds>(publishing_, Clock::now() - integrated);
    held_ = std::move(published);
  }
  // Back to empty maps, with the memory of what it has taken.
  void Reset() {
    builder_.Reset();
    held_ = builder_.Publish();  // the end of the maps before, which no scan shall pay for
    publishing_ = Milliseconds(0);
  }

  double publish_ms() const { return publishing_.count(); }
  const SceneSnapshot& scene() const { return *held_; }

 private:
  ThreadPool pool_;
  SceneBuilder builder_;
  ScenePtr held_;
  Milliseconds publishing_{0};  // the longest from an integration's end to the version
};

// Has taken the frames once: what a process pays for its first scans alone is not counted.
std::unique_ptr<Integrator> WarmIntegrator(const Input& input, bool discretize, int threads) {
  auto integrator = std::make_unique<Integrator>(ParamsFor(input, discretize), threads);
  for (const Frame& frame : input.frames) integrator->Take(frame);
  return integrator;
}

struct Cost {
  double publish_ms = 0;  // the longest
  double memory_mb = 0;   // of the last version's maps, all indexes included
};

Cost Clearway(benchmark::State& state, const Input& input, bool discretize) {
  const std::unique_ptr<Integrator> integrator = WarmIntegrator(input, discretize, 1);
  double publish_ms = 0;
  for (auto _ : state) {
    integrator->Reset();
    for (const Frame& frame : input.frames) integrator->Take(frame);
    publish_ms = std::max(publish_ms, integrator->publish_ms());
  }
  return {publish_ms, MapsMb(integrator->scene())};
}

// Milliseconds a scan takes, over a few rounds.
double ScanMs(Integrator& integrator, const Input& input) {
  constexpr int kRounds = 5;
  Milliseconds spent(0);
  for (int round = 0; round < kRounds; ++round) {
    integrator.Reset();
    const auto begin = Clock::now();
    for (const Frame& frame : input.frames) integrator.Take(frame);
    spent += Clock::now() - begin;
  }
  return spent.count() / (kRounds * static_cast<double>(input.frames.size()));
}

// The same scans with one thread and with two, in turn: what disturbs one disturbs the other.
void OneAndTwoThreads(benchmark::State& state, const Input& input) {
  const auto one = WarmIntegrator(input, false, 1), two = WarmIntegrator(input, false, 2);
  for (auto _ : state) {
    state.counters["scan_1thread_ms"] = ScanMs(*one, input);
    state.counters["scan_2threads_ms"] = ScanMs(*two, input);
    if (!SameContent(one->scene(), two->scene())) state.SkipWithError("the maps differ");
  }
}

// Of ours, which take a second or less and OctoMap minutes: one could meet a bad moment.
constexpr int kIterations = 5;

void AddPair(const std::string& name, const Effort& effort, const InputPtr& input,
             bool discretize) {
  Add("octomap_" + name, effort, [=](auto& state) { Octomap(state, *input, discretize); });
  Add(
      "clearway_" + name, effort, [=](auto& state) { Clearway(state, *input, discretize); },
      kIterations);
}

void Register(Effort effort) {
  effort.repetitions = std::min(effort.repetitions, 5);  // OctoMap takes minutes for each
  const auto whole = std::make_shared<Input>(WholeScans(effort.quick ? 3 : 20), 0.1, 50);
  Add("octomap_whole", effort,
      [=](auto& state) { state.counters["octomap_memory_mb"] = Octomap(state, *whole, false); });
  Add(
      "clearway_whole", effort,
      [=](auto& state) {
        const Cost cost = Clearway(state, *whole, false);
        state.counters["publish_ms"] = cost.publish_ms;
        state.counters["memory_mb"] = cost.memory_mb;
      },
      kIterations);
  Add("clearway_threads", effort, [=](auto& state) { OneAndTwoThreads(state, *whole); });
  AddPair("discrete", effort, whole, true);
  AddPair("fov", effort, std::make_shared<Input>(LabelledScans(effort.quick ? 5 : 20), 0.1, 50),
          false);
  AddPair("depth", effort, std::make_shared<Input>(DepthFrames(effort.quick ? 2 : 10), 0.05, -1),
          false);
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(
      argc, argv, clearway::bench::Register,
      {{"integrate_vs_octomap_x", "octomap_whole", "clearway_whole"},
       {"integrate_discrete_vs_octomap_x", "octomap_discrete", "clearway_discrete"},
       {"integrate_2threads_x", "scan_1thread_ms", "scan_2threads_ms"},
       {"integrate_fov_vs_octomap_x", "octomap_fov", "clearway_fov"},
       {"integrate_depth_vs_octomap_x", "octomap_depth", "clearway_depth"},
       {"memory_vs_octomap_x", "octomap_memory_mb", "memory_mb"}},
      clearway::bench::Order::kInTurns);
}
