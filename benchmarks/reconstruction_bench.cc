// How well maps fit the simulator's street: exact SLAM, by rays that spare what they graze and by
// OctoMap's rule; with the errors of the paper's Table I, with views where the source says, where
// they fit the objects' maps, and with labels filtered too; and with labels filtered, right ones
// and some of them wrong. And what becomes of movers there that nobody labelled, with dynamic space
// and without.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "clearway/report/surface_judge.h"
#include "clearway/report/unlabelled_score.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/missed_objects.h"
#include "clearway/sim/scenarios.h"
#include "clearway/sim/wrong_labels.h"
#include "summary.h"

namespace clearway::bench {
namespace {

using Fits = std::map<ObjectId, ObjectFit>;

void CountObjects(const Fits& fits, const std::string& suffix, benchmark::State& state) {
  const SceneFit scene = Together(fits);
  state.counters["reconstruction_accuracy_voxels" + suffix] = scene.worst_accuracy_voxels;
  state.counters["reconstruction_completeness" + suffix] = scene.together.Completeness();
  state.counters["reconstruction_worst_completeness" + suffix] = scene.worst_completeness;
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
  state.counters["prediction_whole_solids_1s_f" + suffix] = all.WholeFScore();
}

struct Setup {
  ScenarioOptions options;
  double grazing_m = 4;
  bool registered = false;  // views, to their objects' maps
  bool mended = false;      // the sensor's poses, by the static map
  bool filter_labels = false;
  double wrong_labels = 0;  // share of all
  SolidMode solid = SolidMode::kConvexHull;
};

SceneParams ParamsOf(const Setup& setup, const Simulation& simulation) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = simulation.spec().resolution_m;
  params.rays = {.max_range_m = 50, .grazing_m = setup.grazing_m};
  params.filter_labels = setup.filter_labels;
  params.solid = setup.solid;
  if (setup.registered) {
    params.object_pose_error_m = setup.options.noise.object.mean_translation_m;
    params.object_pose_error_rad = setup.options.noise.object.mean_rotation_rad;
  }
  if (setup.mended) {
    params.sensor_pose_error_m = setup.options.noise.sensor.mean_translation_m;
    params.sensor_pose_error_rad = setup.options.noise.sensor.mean_rotation_rad;
  }
  return params;
}

// Counts everything, and returns how the objects fit.
Fits Reconstruct(const Setup& setup, const std::string& suffix, benchmark::State& state) {
  const Simulation simulation = *MakeScenario("street", setup.options);
  ThreadPool pool(1);
  SceneBuilder builder(ParamsOf(setup, simulation), {}, pool);
  SurfaceJudge judge(simulation, {std::chrono::seconds(1)});
  for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
    Frame frame = simulation.MakeFrame(k);
    const Frame seen = WithWrongLabels(frame, setup.wrong_labels, setup.options.seed);
    const auto report = builder.Apply(seen);
    if (!report.ok()) std::abort();
    frame.T_W_S = *report->T_W_S;
    judge.Add(k, frame, *builder.Publish());
  }
  CountObjects(judge.Fits(), suffix, state);
  CountSolids(judge.overlaps(), suffix, state);
  CountStatic(judge.FitOfStatic(*builder.Publish()), suffix, state);
  return judge.Fits();
}

// Without what makes up for it; with registered views; with filtered labels too, right ones and
// some of them wrong, and with completed hulls; and with the sensor's poses mended instead.
void WithNoise(benchmark::State& state, const ScenarioOptions& noisy) {
  for (auto _ : state) {
    const Fits as_told = Reconstruct({.options = noisy}, "_table1", state);
    const auto compare = [&](const Setup& setup, const std::string& suffix) {
      const Fits fits = Reconstruct(setup, suffix, state);
      state.counters["reconstruction" + suffix + "_accuracy_x"] =
          Together(as_told).worst_accuracy_voxels / Together(fits).worst_accuracy_voxels;
      state.counters["reconstruction" + suffix + "_completeness_x"] =
          Together(fits).together.Completeness() / Together(as_told).together.Completeness();
    };
    Setup setup{.options = noisy, .registered = true};
    compare(setup, "_registered");
    setup.filter_labels = true;
    compare(setup, "_refined");
    setup.solid = SolidMode::kCompletedHull;
    compare(setup, "_refined_completed");
    setup.solid = SolidMode::kConvexHull;
    setup.wrong_labels = 0.05;
    compare(setup, "_refined_mislabelled");
    compare({.options = noisy, .registered = true, .mended = true}, "_mended");
  }
}

// With right labels, and with some of them wrong.
void WithFilter(benchmark::State& state, const ScenarioOptions& exact) {
  for (auto _ : state) {
    const Setup right{.options = exact, .filter_labels = true};
    const Fits fits = Reconstruct(right, "_filtered", state);
    Setup wrong = right;
    wrong.wrong_labels = 0.05;
    const Fits of_wrong = Reconstruct(wrong, "_mislabelled", state);
    state.counters["reconstruction_mislabelled_accuracy_x"] =
        Together(of_wrong).worst_accuracy_voxels / Together(fits).worst_accuracy_voxels;
  }
}

// Of a street where nobody labels anything.
Unlabelled Missed(const ScenarioOptions& options, Duration dynamic_life) {
  const Simulation simulation = *MakeScenario("street", options);
  SceneParams params = ParamsOf({.options = options}, simulation);
  params.dynamic_life = dynamic_life;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  const std::vector<ObjectId> ids = simulation.world().ObjectIds();
  const std::set<ObjectId> movers(ids.begin(), ids.end());
  UnlabelledScore score(TruthOf(std::make_shared<const World>(simulation.world()),
                                simulation.StampOf(simulation.frame_count() - 1)),
                        movers);
  for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
    const Frame frame = simulation.MakeFrame(k);
    if (!builder.Apply(WithoutObjects(frame, movers)).ok()) std::abort();
    score.Add(frame, *builder.Publish());
  }
  return score.Result();
}

void WithoutLabels(benchmark::State& state, const ScenarioOptions& exact) {
  for (auto _ : state) {
    const Unlabelled with = Missed(exact, std::chrono::milliseconds(500));
    const Unlabelled without = Missed(exact, Duration::zero());
    state.counters["unlabelled_occupied_at_once"] = with.ShareOccupied();
    state.counters["unlabelled_occupied_at_once_without"] = without.ShareOccupied();
    state.counters["unlabelled_trail_voxels"] = with.MeanTrail();
    state.counters["unlabelled_trail_voxels_without"] = without.MeanTrail();
    state.counters["unlabelled_dynamic_elsewhere_fraction"] =
        static_cast<double>(with.dynamic_elsewhere) / static_cast<double>(with.dynamic);
  }
}

void Register(const Effort& effort) {
  Effort once = effort;
  once.repetitions = 1;
  ScenarioOptions exact;
  if (effort.quick) exact.frame_count = 60;
  ScenarioOptions noisy = exact;
  noisy.noise = SlamNoise::TableOne();
  Add("reconstruction", once, [=](auto& state) {
    for (auto _ : state) Reconstruct({.options = exact}, "", state);
  });
  Add("reconstruction_completed", once, [=](auto& state) {
    const Setup setup{.options = exact, .solid = SolidMode::kCompletedHull};
    for (auto _ : state) Reconstruct(setup, "_completed", state);
  });
  Add("reconstruction_octomap", once, [=](auto& state) {
    for (auto _ : state) Reconstruct({.options = exact, .grazing_m = 0}, "_octomap", state);
  });
  Add("reconstruction_filtered", once, [=](auto& state) { WithFilter(state, exact); });
  Add("reconstruction_unlabelled", once, [=](auto& state) { WithoutLabels(state, exact); });
  Add("reconstruction_table1", once, [=](auto& state) { WithNoise(state, noisy); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
