// How far from their recorded boxes the objects of the real drive are predicted: by their tracks,
// where what only seems to move is told from what moves; and by the paper's rule (their last motion
// goes on).
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>
#include <string>

#include "clearway/io/lidar_folder.h"
#include "clearway/report/prediction_score.h"
#include "clearway/scene/scene_builder.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

constexpr ObjectId kVan = 1, kCyclist = 2, kParked = 4;

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

std::map<ObjectId, std::vector<PredictionErrors>> ErrorsOn(const LidarFolder& folder,
                                                           const SceneParams& params) {
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  PredictionScore score(TruthOf(folder), {std::chrono::seconds(1)});
  for (std::size_t k = 0; k < folder.frames.frame_count; ++k) {
    const auto frame = folder.frames.read(k);
    if (!frame.ok() || !builder.Apply(*frame).ok()) std::abort();
    score.Add(*builder.Publish());
  }
  return score.Errors();
}

void Predict(benchmark::State& state, const std::string& path, LidarPoses poses,
             const std::string& suffix, const SceneParams& params) {
  for (auto _ : state) {
    const auto folder = OpenLidarFolder(path, {.poses = poses});
    if (!folder.ok()) return state.SkipWithError(folder.status().ToString().c_str());
    const auto errors = ErrorsOn(*folder, params);
    for (const auto& [id, name] :
         {std::pair{kVan, "van"}, {kCyclist, "cyclist"}, {kParked, "parked"}}) {
      state.counters[std::string("prediction_") + name + suffix + "_1s_m"] =
          errors.at(id)[0].Median();
    }
  }
}

void Register(const Effort& effort) {
  const auto path = DataPath("kitti0000_fov");
  if (!path) return;  // it has said so
  Effort once = effort;
  once.repetitions = 1;
  const std::string folder = *path;
  Add("prediction_last_motion", once, [=](auto& state) {
    Predict(state, folder, LidarPoses::kIcp, "_last_motion", ByLastMotion());
  });
  Add("prediction", once,
      [=](auto& state) { Predict(state, folder, LidarPoses::kIcp, "", ByTrack()); });
  Add("prediction_oxts", once,
      [=](auto& state) { Predict(state, folder, LidarPoses::kOxts, "_oxts", ByTrack()); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
