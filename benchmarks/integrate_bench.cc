// Scans into maps, against OctoMap's insertPointCloud with the same range: whole scans of a real
// drive into the static map (every ray, one ray per end voxel, two threads), a labelled drive with
// its moving objects, and depth images. Ours includes a frame's checks and the publication of a
// version after each scan, while a reader still holds the one before.
#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include <chrono>

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

struct Cost {
  // The longest from the end of an integration to its version being readable.
  double publish_ms = 0;
  double memory_mb = 0;  // of the last version's maps, all indexes included
};

Cost Clearway(benchmark::State& state, const Input& input, bool discretize, int threads) {
  using Clock = std::chrono::steady_clock;
  ThreadPool pool(threads);
  SceneParams params;
  params.resolution_m = params.object_resolution_m = input.resolution_m;
  params.rays = {input.range_m, discretize};
  ScenePtr held;
  std::chrono::duration<double, std::milli> publishing(0);
  for (auto _ : state) {
    SceneBuilder builder(params, {}, pool);
    for (const Frame& frame : input.frames) {
      if (!builder.Apply(frame).ok()) state.SkipWithError("a frame was refused");
      const auto integrated = Clock::now();
      ScenePtr published = builder.Publish();
      publishing = std::max<decltype(publishing)>(publishing, Clock::now() - integrated);
      held = std::move(published);
    }
  }
  return {publishing.count(), MapsMb(*held)};
}

void Add(const std::string& name, const Effort& effort,
         const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(1)
      ->Repetitions(effort.repetitions())
      ->UseRealTime()
      ->ReportAggregatesOnly();
}

void AddPair(const std::string& name, const Effort& effort, const InputPtr& input,
             bool discretize) {
  Add("octomap_" + name, effort, [=](auto& state) { Octomap(state, *input, discretize); });
  Add("clearway_" + name, effort, [=](auto& state) { Clearway(state, *input, discretize, 1); });
}

void Register(const Effort& effort) {
  const auto whole = std::make_shared<Input>(WholeScans(effort.quick ? 3 : 20), 0.1, 50);
  Add("octomap_whole", effort,
      [=](auto& state) { state.counters["octomap_memory_mb"] = Octomap(state, *whole, false); });
  Add("clearway_whole", effort, [=](auto& state) {
    const Cost cost = Clearway(state, *whole, false, 1);
    state.counters["publish_ms"] = cost.publish_ms;
    state.counters["memory_mb"] = cost.memory_mb;
  });
  Add("clearway_2threads", effort, [=](auto& state) { Clearway(state, *whole, false, 2); });
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
       {"integrate_2threads_x", "clearway_whole", "clearway_2threads"},
       {"integrate_fov_vs_octomap_x", "octomap_fov", "clearway_fov"},
       {"integrate_depth_vs_octomap_x", "octomap_depth", "clearway_depth"},
       {"memory_vs_octomap_x", "octomap_memory_mb", "memory_mb"}});
}
