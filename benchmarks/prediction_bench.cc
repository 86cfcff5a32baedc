// How far from their recorded boxes the objects of the real drive are predicted: by their tracks,
// where what only seems to move is told from what moves; and by the paper's rule (their last motion
// goes on). And how often they keep within the bounds that are stated of them, there, among the
// tracks of another drive, and in the simulator: on the street with the errors of the paper's Table
// I, and in the lab, where boxes swing.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <numbers>
#include <string>

#include "absl/strings/str_cat.h"
#include "box_corners.h"
#include "clearway/io/lidar_folder.h"
#include "clearway/report/box_fit.h"
#include "clearway/report/prediction_score.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

constexpr ObjectId kVan = 1, kCyclist = 2, kParked = 4;

constexpr std::array kAhead = {std::chrono::milliseconds(1000), std::chrono::milliseconds(500),
                               std::chrono::milliseconds(2000), std::chrono::milliseconds(3000)};

SceneParams ByLastMotion() {
  SceneParams params;
  params.rays.max_range_m = 50;
  return params;
}

SceneParams ByTrack() {
  SceneParams params = ByLastMotion();
  params.motion = MotionModel::kTrack;
  params.rest_distance_m = 0.6;  // as the demo's
  return params;
}

struct Judged {
  std::map<ObjectId, std::vector<PredictionErrors>> errors;
  std::map<ObjectId, BoxFit> sizes;
};

// The recorded boxes, which were measured from the sensor, in the world of the scene.
Truth TruthFor(const LidarFolder& folder, const SceneParams& params) {
  if (!params.MendsSensorPoses()) return TruthOf(folder);
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  WorldCorrections corrections(Duration::max());
  for (std::size_t k = 0; k < folder.frames.frame_count; ++k) {
    const auto frame = folder.frames.read(k);
    if (!frame.ok()) std::abort();
    const auto report = builder.Apply(*frame);
    if (!report.ok()) std::abort();
    corrections.Add(frame->stamp, *report->T_W_S * Inverse(frame->T_W_S));
  }
  return CarriedBy(std::move(corrections), TruthOf(folder));
}

Judged JudgedOn(const LidarFolder& folder, const SceneParams& params, bool boxes_alone) {
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  const Truth truth = TruthFor(folder, params);
  PredictionScore score(truth, {kAhead.begin(), kAhead.end()});
  BoxFitter sizes(truth);
  for (std::size_t k = 0; k < folder.frames.frame_count; ++k) {
    auto frame = folder.frames.read(k);
    if (frame.ok() && boxes_alone) SeeBoxes(folder, *frame);
    if (!frame.ok() || !builder.Apply(*frame).ok()) std::abort();
    const ScenePtr scene = builder.Publish();
    score.Add(*scene);
    sizes.Add(*scene);
  }
  return {score.Errors(), sizes.Fits()};
}

// Of all objects together, by time ahead and of all of these.
void CountWithin(const std::map<ObjectId, std::vector<PredictionErrors>>& errors,
                 const std::string& suffix, benchmark::State& state) {
  double within = 0, all = 0;
  const std::string name = "prediction_within" + suffix;
  for (std::size_t i = 0; i < kAhead.size(); ++i) {
    double within_then = 0, all_then = 0;
    for (const auto& [id, of_object] : errors) {
      within_then += static_cast<double>(of_object[i].within);
      all_then += static_cast<double>(of_object[i].errors_m.size());
    }
    state.counters[absl::StrCat(name, "_", ToSeconds(kAhead[i]), "s")] = within_then / all_then;
    within += within_then;
    all += all_then;
  }
  state.counters[name] = within / all;
}

// Whether scans are registered to the static map where the source's poses are said to drift.
enum class Drift { kMended, kLeft };

void Predict(benchmark::State& state, const std::string& path, LidarPoses poses,
             const std::string& suffix, SceneParams params, Drift drift = Drift::kMended) {
  for (auto _ : state) {
    const auto folder = OpenLidarFolder(path, {.poses = poses});
    if (!folder.ok()) return state.SkipWithError(folder.status().ToString().c_str());
    if (drift == Drift::kMended) {
      params.sensor_pose_error_m = folder->frames.sensor_pose_error_m;
      params.sensor_pose_error_rad = folder->frames.sensor_pose_error_rad;
    }
    const auto [errors, sizes] = JudgedOn(*folder, params, false);
    state.counters["reconstruction_van_size_off" + suffix + "_m"] =
        sizes.at(kVan).WorstDifference_m();
    CountWithin(errors, suffix, state);
    for (const auto& [id, name] :
         {std::pair{kVan, "van"}, {kCyclist, "cyclist"}, {kParked, "parked"}}) {
      state.counters[std::string("prediction_") + name + suffix + "_1s_m"] =
          errors.at(id)[0].Median();
    }
  }
}

// Of 146 objects: pedestrians, vehicles, bollards.
void PredictBoxes(benchmark::State& state, const std::string& path) {
  for (auto _ : state) {
    const auto folder = OpenLidarFolder(path, {.allow_missing_points = true});
    if (!folder.ok()) return state.SkipWithError(folder.status().ToString().c_str());
    SceneParams params = ByTrack();
    params.rays.max_range_m = -1;
    params.resolution_m = 2;  // it is of no interest
    CountWithin(JudgedOn(*folder, params, true).errors, "_av2", state);
  }
}

// With views registered to their objects' maps, of a source whose poses are off by what Table I
// says.
SceneParams Registered(SceneParams params) {
  params.rays.grazing_m = 4;
  params.object_pose_error_m = 0.57;
  params.object_pose_error_rad = 2.91 * std::numbers::pi / 180;
  return params;
}

// And scans to the static map.
SceneParams Mended(SceneParams params) {
  params = Registered(params);
  params.sensor_pose_error_m = 0.29;
  params.sensor_pose_error_rad = 2.09 * std::numbers::pi / 180;
  return params;
}

// All objects of a simulated world.
void PredictSimulated(benchmark::State& state, const std::string& name,
                      const ScenarioOptions& options, const std::string& suffix,
                      const SceneParams& params) {
  for (auto _ : state) {
    const auto simulation = MakeScenario(name, options);
    if (!simulation.ok()) return state.SkipWithError(simulation.status().ToString().c_str());
    const std::size_t frames = simulation->frame_count();
    PredictionScore score(TruthOf(std::make_shared<const World>(simulation->world()),
                                  simulation->StampOf(frames - 1)),
                          {kAhead.begin(), kAhead.end()});
    ThreadPool pool(2);
    SceneBuilder builder(params, {}, pool);
    for (std::size_t k = 0; k < frames; ++k) {
      if (!builder.Apply(simulation->MakeFrame(k)).ok()) std::abort();
      score.Add(*builder.Publish());
    }
    CountWithin(score.Errors(), suffix, state);
  }
}

// With a seed that is not the one that the constants of bounds were fitted to.
void PredictNoisyStreet(benchmark::State& state, const std::string& suffix,
                        const SceneParams& params) {
  PredictSimulated(state, "street", {.seed = 2, .noise = SlamNoise::TableOne()}, "_table1" + suffix,
                   params);
}

void PredictLab(benchmark::State& state, const std::string& suffix, SceneParams params) {
  params.resolution_m = params.object_resolution_m = 0.05;
  params.rest_distance_m = 0;
  PredictSimulated(state, "lab", {}, "_lab" + suffix, params);
}

void Register(const Effort& effort) {
  Effort once = effort;
  once.repetitions = 1;
  SceneParams street = ByTrack();
  street.rest_distance_m = 0;  // none rests, and the noise is as large as a rest's distance
  Add("prediction_street_exact", once,
      [=](auto& state) { PredictSimulated(state, "street", {}, "_street", street); });
  const std::map<std::string, SceneParams> noisy = {
      {"", street},
      {"_registered", Registered(street)},
      {"_mended", Mended(street)},
      {"_last_motion", ByLastMotion()},
      {"_registered_last_motion", Registered(ByLastMotion())},
      {"_mended_last_motion", Mended(ByLastMotion())}};
  for (const auto& with : noisy) {
    Add("prediction_street" + with.first, once,
        [=](auto& state) { PredictNoisyStreet(state, with.first, with.second); });
  }
  Add("prediction_lab", once, [=](auto& state) { PredictLab(state, "", ByTrack()); });
  Add("prediction_lab_last_motion", once,
      [=](auto& state) { PredictLab(state, "_last_motion", ByLastMotion()); });
  if (const auto boxes = DataPath("av2_adcf7d18")) {
    Add("prediction_av2", once, [=](auto& state) { PredictBoxes(state, *boxes); });
  }
  const auto path = DataPath("kitti0000_fov");
  if (!path) return;  // it has said so
  const std::string folder = *path;
  Add("prediction_last_motion", once, [=](auto& state) {
    Predict(state, folder, LidarPoses::kIcp, "_last_motion", ByLastMotion());
  });
  Add("prediction", once,
      [=](auto& state) { Predict(state, folder, LidarPoses::kIcp, "", ByTrack()); });
  Add("prediction_oxts", once,
      [=](auto& state) { Predict(state, folder, LidarPoses::kOxts, "_oxts", ByTrack()); });
  Add("prediction_oxts_left", once, [=](auto& state) {
    Predict(state, folder, LidarPoses::kOxts, "_oxts_left", ByTrack(), Drift::kLeft);
  });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
