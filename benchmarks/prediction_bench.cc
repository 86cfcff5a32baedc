// How far from their recorded boxes the objects of the real drive are predicted, by the paper's
// rule (their last motion goes on) and where what only seems to move is told from what moves.
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
// In a second; as the demo's.
constexpr double kRestDistance_m = 0.6;

std::map<ObjectId, std::vector<PredictionErrors>> ErrorsOn(const LidarFolder& folder,
                                                           double rest_distance_m) {
  SceneParams params;
  params.rays.max_range_m = 50;
  params.rest_distance_m = rest_distance_m;
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
             const std::string& suffix, double rest_distance_m) {
  for (auto _ : state) {
    const auto folder = OpenLidarFolder(path, {.poses = poses});
    if (!folder.ok()) return state.SkipWithError(folder.status().ToString().c_str());
    const auto errors = ErrorsOn(*folder, rest_distance_m);
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
  Add("prediction_last_motion", once,
      [=](auto& state) { Predict(state, folder, LidarPoses::kIcp, "_last_motion", 0); });
  Add("prediction", once,
      [=](auto& state) { Predict(state, folder, LidarPoses::kIcp, "", kRestDistance_m); });
  Add("prediction_oxts", once,
      [=](auto& state) { Predict(state, folder, LidarPoses::kOxts, "_oxts", kRestDistance_m); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
