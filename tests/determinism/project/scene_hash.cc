// Prints the content of scenes, made of random frames with several parameters, and what they answer
// about points, as hashes.
#include <xxhash.h>

#include <bit>
#include <iostream>

#include "absl/strings/str_cat.h"
#include "clearway/scene/occupancy.h"
#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "support/random.h"
#include "support/rooms.h"

namespace {

using namespace clearway;

std::uint64_t HashOfAnswers(const SceneSnapshot& scene) {
  testing_support::Random random(5);
  std::vector<Eigen::Vector3d> points_W;
  std::vector<Time> times;
  for (int i = 0; i < 20'000; ++i) {
    points_W.push_back(random.Vector(9));
    times.push_back(scene.stamp + FromSeconds(0.1 * random.Integer(0, 9)));
  }
  std::string text;
  for (const PointOccupancy& answer : OccupancyOf(scene, points_W, times)) {
    absl::StrAppend(&text, static_cast<int>(answer.status), " ", answer.object, " ",
                    std::bit_cast<std::uint64_t>(answer.fused_log_odds.value_or(0)), "\n");
  }
  return XXH3_64bits(text.data(), text.size());
}

// Of a source that drifts in a room, and is mended.
std::string HashOfRoom() {
  SceneParams params;
  params.sensor_pose_error_m = 0.2;
  params.sensor_pose_error_rad = 0.02;
  ThreadPool pool(2);
  SceneBuilder builder(params, {}, pool);
  for (int k = 0; k < 5; ++k) {
    const Pose T_W_S = Exp({{0.02 * k, 0.01 * k, 0.1 * k}, {0.1 * k, 0.2, 0.05 * k}});
    const Pose T_V_S = Exp({{0, 0.004 * k, 0.003 * k}, {0.03 * k, -0.02 * k, 0.01 * k}}) * T_W_S;
    if (!builder.Apply(testing_support::ScanOfRoom(0.1 * k, T_W_S, T_V_S)).ok()) return "refused";
  }
  return builder.Publish()->Hash();
}

}  // namespace

int main() {
  for (const bool variant : {false, true}) {
    SceneParams params;
    params.rays = {.max_range_m = 6, .discretize = variant, .grazing_m = variant ? 2.0 : 0};
    params.clear_objects_by_rays = variant;
    params.motion = variant ? MotionModel::kTrack : MotionModel::kLastMotion;
    params.rest_distance_m = variant ? 0.5 : 0;
    params.object_pose_error_m = variant ? 0.1 : 0;
    params.sensor_pose_error_m = variant ? 0.1 : 0;
    params.reidentify = variant;
    params.filter_labels = variant;
    params.dynamic_life = std::chrono::milliseconds(variant ? 500 : 0);
    params.keep_distance_m = variant ? 3 : 0;
    ThreadPool pool(2);
    SceneBuilder builder(params, {}, pool);
    testing_support::RandomFrames frames(variant);
    for (int k = 0; k < 25; ++k) {
      if (const auto report = builder.Apply(frames.Next()); !report.ok()) {
        std::cerr << report.status() << "\n";
        return 1;
      }
    }
    const ScenePtr scene = builder.Publish();
    std::cout << scene->static_map_W.observed_count() << " voxels, " << scene->objects.size()
              << " objects: " << scene->Hash() << ", answers " << HashOfAnswers(*scene) << "\n";
  }
  std::cout << "a room: " << HashOfRoom() << "\n";
}
