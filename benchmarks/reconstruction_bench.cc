// How well maps fit the simulator's street: exact SLAM, and with the errors of the paper's Table I;
// rays spare what they graze, and by OctoMap's rule.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>

#include "clearway/report/surface_judge.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "summary.h"

namespace clearway::bench {
namespace {

// Of the object that fits worst, or of the pieces and voxels of all.
void CountObjects(const std::map<ObjectId, ObjectFit>& fits, const std::string& suffix,
                  benchmark::State& state) {
  double worst_voxels = 0;
  std::size_t met = 0, covered = 0;
  for (const auto& [id, fit] : fits) {
    worst_voxels = std::max(worst_voxels, fit.Accuracy_m() / fit.voxel_m);
    met += fit.met;
    covered += fit.covered;
  }
  state.counters["reconstruction_accuracy_voxels" + suffix] = worst_voxels;
  state.counters["reconstruction_completeness" + suffix] =
      static_cast<double>(covered) / static_cast<double>(met);
  state.counters["reconstruction_objects" + suffix] = static_cast<double>(fits.size());
}

void CountStatic(const StaticFit& fit, const std::string& suffix, benchmark::State& state) {
  state.counters["reconstruction_residual_voxels" + suffix] = static_cast<double>(fit.Residual());
  state.counters["reconstruction_occupied_precision" + suffix] = fit.OccupiedPrecision();
  state.counters["reconstruction_occupied_recall" + suffix] = fit.OccupiedRecall();
  state.counters["reconstruction_free_precision" + suffix] = fit.FreePrecision();
  state.counters["reconstruction_free_recall" + suffix] = fit.FreeRecall();
}

void CountSolids(const std::map<ObjectId, std::vector<SolidOverlap>>& overlaps,
                 const std::string& suffix, benchmark::State& state) {
  SolidOverlap all;
  for (const auto& [id, of_object] : overlaps) all += of_object[0];
  state.counters["prediction_solids_1s_f" + suffix] = all.FScore();
}

constexpr double kGrazing_m = 4;

void Reconstruct(benchmark::State& state, const ScenarioOptions& options, double grazing_m,
                 const std::string& suffix) {
  const Simulation simulation = *MakeScenario("street", options);
  for (auto _ : state) {
    SceneParams params;
    params.resolution_m = params.object_resolution_m = simulation.spec().resolution_m;
    params.rays = {.max_range_m = 50, .grazing_m = grazing_m};
    ThreadPool pool(1);
    SceneBuilder builder(params, {}, pool);
    SurfaceJudge judge(simulation, {std::chrono::seconds(1)});
    for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
      const Frame frame = simulation.MakeFrame(k);
      if (!builder.Apply(frame).ok()) std::abort();
      judge.Add(k, frame, *builder.Publish());
    }
    CountObjects(judge.Fits(), suffix, state);
    CountSolids(judge.overlaps(), suffix, state);
    CountStatic(judge.FitOfStatic(*builder.Publish()), suffix, state);
  }
}

void Register(const Effort& effort) {
  Effort once = effort;
  once.repetitions = 1;
  ScenarioOptions exact;
  if (effort.quick) exact.frame_count = 60;
  ScenarioOptions noisy = exact;
  noisy.noise = SlamNoise::TableOne();
  Add("reconstruction", once, [=](auto& state) { Reconstruct(state, exact, kGrazing_m, ""); });
  Add("reconstruction_octomap", once,
      [=](auto& state) { Reconstruct(state, exact, 0, "_octomap"); });
  Add("reconstruction_table1", once,
      [=](auto& state) { Reconstruct(state, noisy, kGrazing_m, "_table1"); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
