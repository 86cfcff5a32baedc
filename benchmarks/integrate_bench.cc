// Scans into the static map: every ray and one ray per end voxel, one thread and two, against
// OctoMap's insertPointCloud with the same range. Ours includes a frame's checks and the
// publication of a version after each scan, while a reader still holds the one before.
#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include "clearway/scene/scene_builder.h"
#include "recorded_scans.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr double kResolution_m = 0.1;
constexpr double kRange_m = 50;

void Octomap(benchmark::State& state, const std::vector<Frame>& scans, bool discretize) {
  std::vector<octomap::Pointcloud> clouds;
  for (const Frame& scan : scans) {
    octomap::Pointcloud& cloud = clouds.emplace_back();
    for (const Eigen::Vector3f& p : PointsInWorld(scan)) cloud.push_back(p.x(), p.y(), p.z());
  }
  for (auto _ : state) {
    octomap::OcTree tree(kResolution_m);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const Eigen::Vector3f origin = scans[i].T_W_S.translation.cast<float>();
      tree.insertPointCloud(clouds[i], {origin.x(), origin.y(), origin.z()}, kRange_m, false,
                            discretize);
    }
  }
}

void Clearway(benchmark::State& state, const std::vector<Frame>& scans, bool discretize,
              int threads) {
  ThreadPool pool(threads);
  SceneParams params;
  params.resolution_m = kResolution_m;
  params.rays = {kRange_m, discretize};
  for (auto _ : state) {
    SceneBuilder builder(params, {}, pool);
    ScenePtr held;
    for (const Frame& scan : scans) {
      if (!builder.Apply(scan).ok()) state.SkipWithError("a scan was refused");
      held = builder.Publish();
    }
    benchmark::DoNotOptimize(held);
  }
}

void Register(const Effort& effort) {
  const auto scans = std::make_shared<std::vector<Frame>>(WholeScans(effort.quick ? 3 : 20));
  const auto add = [&](const char* name, auto run) {
    benchmark::RegisterBenchmark(name,
                                 [scans, run](benchmark::State& state) { run(state, *scans); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->Repetitions(effort.repetitions())
        ->UseRealTime()
        ->ReportAggregatesOnly();
  };
  using State = benchmark::State;
  using Scans = std::vector<Frame>;
  add("octomap", [](State& s, const Scans& all) { Octomap(s, all, false); });
  add("octomap_discrete", [](State& s, const Scans& all) { Octomap(s, all, true); });
  add("clearway", [](State& s, const Scans& all) { Clearway(s, all, false, 1); });
  add("clearway_discrete", [](State& s, const Scans& all) { Clearway(s, all, true, 1); });
  add("clearway_2threads", [](State& s, const Scans& all) { Clearway(s, all, false, 2); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(
      argc, argv, clearway::bench::Register,
      {{"integrate_vs_octomap_x", "octomap", "clearway"},
       {"integrate_discrete_vs_octomap_x", "octomap_discrete", "clearway_discrete"},
       {"integrate_2threads_x", "clearway", "clearway_2threads"}});
}
