// Objects of which a source gives points alone (instance masks), neither motions nor poses, or none
// from a time on: their motions are estimated from the points. How well solids that are predicted a
// second ahead agree with the true ones on the simulated street; and how far the objects of the
// real drive are then from their recorded boxes, and how large.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "clearway/io/lidar_folder.h"
#include "clearway/report/box_fit.h"
#include "clearway/report/prediction_score.h"
#include "clearway/report/surface_judge.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "ended_reports.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

constexpr ObjectId kVan = 1, kCyclist = 2, kParked = 4;
constexpr Duration kAhead = std::chrono::seconds(1);
constexpr std::size_t kMostFrames = 160;

SceneParams Params() {
  SceneParams params;
  params.rays.max_range_m = 50;
  return params;
}

void Street(benchmark::State& state, const ScenarioOptions& options) {
  for (auto _ : state) {
    const Simulation simulation = *MakeScenario("street", options);
    ThreadPool pool(1);
    SceneBuilder builder(Params(), {}, pool);
    SurfaceJudge judge(simulation, {kAhead});
    double restarted = 0;
    for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
      const Frame frame = simulation.MakeFrame(k);
      const auto report = builder.Apply(frame);
      if (!report.ok()) std::abort();
      restarted += static_cast<double>(report->objects_restarted);
      judge.Add(k, frame, *builder.Publish());
    }
    SolidOverlap all;
    for (const auto& [id, of_object] : judge.overlaps()) all += of_object[0];
    state.counters["masks_street_solids_1s_f"] = all.FScore();
    state.counters["masks_street_solids_1s_precision"] = all.Precision();
    state.counters["masks_street_solids_1s_recall"] = all.Recall();
    state.counters["masks_street_restarted"] = restarted;
  }
}

void Drive(benchmark::State& state, const std::string& path) {
  for (auto _ : state) {
    const auto folder = OpenLidarFolder(path, {.objects = LidarObjects::kNone});
    if (!folder.ok()) return state.SkipWithError(folder.status().ToString().c_str());
    ThreadPool pool(1);
    SceneBuilder builder(Params(), {}, pool);
    const Truth truth = TruthOf(*folder);
    PredictionScore score(truth, {kAhead});
    BoxFitter sizes(truth);
    for (std::size_t k = 0; k < folder->frames.frame_count; ++k) {
      const auto frame = folder->frames.read(k);
      if (!frame.ok() || !builder.Apply(*frame).ok()) std::abort();
      const ScenePtr scene = builder.Publish();
      score.Add(*scene);
      sizes.Add(*scene);
    }
    const auto errors = score.Errors();
    state.counters["masks_van_1s_m"] = errors.at(kVan)[0].Median();
    state.counters["masks_cyclist_1s_m"] = errors.at(kCyclist)[0].Median();
    state.counters["masks_parked_1s_m"] = errors.at(kParked)[0].Median();
    double worst_m = 0;
    for (const auto& [id, fit] : sizes.Fits()) {
      worst_m = std::max(worst_m, fit.WorstDifference_m());
    }
    state.counters["masks_worst_size_off_m"] = worst_m;
  }
}

// With `drive` both ways: followed by its points, and not.
void Silence(benchmark::State& state, const std::string& name, const ReportedDrive& drive) {
  for (auto _ : state) {
    for (const auto& [from_points, way] : {std::pair(MotionFromPoints::kAuto, "_followed_"),
                                           std::pair(MotionFromPoints::kOff, "_left_")}) {
      const EndedReports ended = AfterReportsEnd(drive, from_points);
      const std::string start = "silent_" + name + way;
      state.counters[start + "predictions"] = ended.predictions;
      state.counters[start + "miss_1s_m"] = ended.miss_m;
      state.counters[start + "bound_1s_m"] = ended.bound_m;
      state.counters[start + "within"] = ended.held;
      state.counters[start + "in_solid"] = ended.in_solid;
      state.counters[start + "begun_anew"] = ended.begun_anew;
    }
  }
}

ReportedDrive Simulated(const std::string& scenario) {
  const auto simulation = std::make_shared<Simulation>(*MakeScenario(scenario, {}));
  ReportedDrive drive;
  drive.resolution_m = simulation->spec().resolution_m;
  for (std::size_t k = 0; k < simulation->frame_count() && k < kMostFrames; ++k) {
    drive.frames.push_back(simulation->MakeFrame(k));
  }
  drive.T_W_B = [simulation](ObjectId id, std::size_t frame) {
    return simulation->ReportedT_W_B(id, frame);
  };
  return drive;
}

ReportedDrive Recorded(const std::string& path) {
  const auto folder = OpenLidarFolder(path, {});
  if (!folder.ok()) std::abort();
  ReportedDrive drive;
  drive.resolution_m = folder->frames.resolution_m;
  for (std::size_t k = 0; k < folder->frames.frame_count && k < kMostFrames; ++k) {
    drive.frames.push_back(*folder->frames.read(k));
  }
  std::map<std::pair<ObjectId, std::size_t>, Pose> boxes;
  for (const RecordedBox& box : folder->boxes) {
    boxes[{box.id, static_cast<std::size_t>(box.frame)}] = box.T_W_B;
  }
  drive.T_W_B = [boxes](ObjectId id, std::size_t frame) -> std::optional<Pose> {
    const auto box = boxes.find({id, frame});
    return box == boxes.end() ? std::nullopt : std::optional(box->second);
  };
  return drive;
}

void Register(const Effort& effort) {
  Effort once = effort;
  once.repetitions = 1;
  ScenarioOptions masks{.report = ObjectReport::kNothing};
  if (effort.quick) masks.frame_count = 60;
  Add("masks_street", once, [=](auto& state) { Street(state, masks); });
  for (const char* name : {"street", "queues", "occlusions"}) {
    if (effort.quick) break;
    Add(std::string("silent_") + name, once,
        [=](auto& state) { Silence(state, name, Simulated(name)); });
  }
  const auto path = DataPath("kitti0000_fov");
  if (!path) return;  // it has said so
  Add("masks_drive", once, [folder = *path](auto& state) { Drive(state, folder); });
  if (effort.quick) return;
  Add("silent_drive", once,
      [folder = *path](auto& state) { Silence(state, "drive", Recorded(folder)); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
