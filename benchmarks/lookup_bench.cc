// Points looked up in the static map against OctoMap's search: at random, and one voxel after the
// other along lines. And what moving objects elsewhere add to a point's status at its own time.
#include <benchmark/benchmark.h>

#include "clearway/map/voxel_reader.h"
#include "clearway/scene/timed_scene.h"
#include "drive_map.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr double kTurn_s = 0.1;  // of one benchmark, before another's

using Points = std::vector<Eigen::Vector3d>;

Points RandomPoints(const Aabb& box_W, std::size_t count) {
  Dice dice;
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(dice.PointIn(box_W));
  return points;
}

// Lines of 100 points, 5 cm apart.
Points PointsOnLines(const Aabb& box_W, std::size_t count) {
  Dice dice;
  Points points;
  while (points.size() < count) {
    const Eigen::Vector3d start_W = dice.PointIn(box_W);
    const Eigen::Vector3d step = dice.Rotation() * Eigen::Vector3d(0.05, 0, 0);
    for (int i = 0; i < 100; ++i) points.push_back(start_W + i * step);
  }
  return points;
}

VoxelState StateIn(const octomap::OcTree& tree, const Eigen::Vector3d& p) {
  const octomap::OcTreeNode* node = tree.search(p.x(), p.y(), p.z());
  if (node == nullptr) return VoxelState::kUnknown;
  return tree.isNodeOccupied(node) ? VoxelState::kOccupied : VoxelState::kFree;
}

void Octomap(benchmark::State& state, const DriveMap& drive, const Points& points_W) {
  std::vector<VoxelState> states(points_W.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < points_W.size(); ++i) {
      states[i] = StateIn(*drive.tree, points_W[i]);
    }
    benchmark::DoNotOptimize(states.data());
  }
}

void Clearway(benchmark::State& state, const DriveMap& drive, const Points& points_W) {
  const VoxelMap& map = drive.scene->static_map_W;
  std::vector<VoxelState> states(points_W.size());
  VoxelReader reader(map);
  for (auto _ : state) {
    reader.States(points_W, states);
    benchmark::DoNotOptimize(states.data());
  }
  for (std::size_t i = 0; i < points_W.size(); ++i) {
    if (states[i] != StateIn(*drive.tree, points_W[i])) state.SkipWithError("OctoMap disagrees");
  }
}

// Random points at 64 times of the next 5 s.
void Statuses(benchmark::State& state, const SceneSnapshot& scene, const Points& points_W) {
  std::vector<Time> times;
  for (std::size_t i = 0; i < points_W.size(); ++i) {
    times.push_back(scene.stamp + std::chrono::milliseconds(i % 64 * 78));
  }
  std::vector<PointOccupancy> answers(points_W.size());
  for (auto _ : state) {
    TimedScene timed(scene, scene.stamp, scene.stamp + FromSeconds(5));
    timed.At(points_W, times, answers);
    benchmark::DoNotOptimize(answers.data());
  }
}

void Register(const Effort& effort) {
  const auto drive = std::make_shared<DriveMap>(MakeDriveMap(effort.quick ? 5 : 20));
  const Aabb all_W = drive->scene->static_map_W.ObservedBox();
  const auto add = [&](const std::string& name, auto run, const Points& points) {
    benchmark::RegisterBenchmark(name.c_str(), [=](auto& state) { run(state, *drive, points); })
        ->Unit(benchmark::kMillisecond)
        ->MinTime(kTurn_s)
        ->Repetitions(3 * effort.repetitions)
        ->ReportAggregatesOnly();
  };
  const Points random = RandomPoints(all_W, 1'000'000), lines = PointsOnLines(all_W, 100'000);
  add("octomap_random", Octomap, random);
  add("clearway_random", Clearway, random);
  add("octomap_coherent", Octomap, lines);
  add("clearway_coherent", Clearway, lines);
  const auto add_statuses = [&](const std::string& name, ScenePtr scene) {
    add(
        name,
        [=](auto& state, const auto&, const auto& points) { Statuses(state, *scene, points); },
        random);
  };
  const double beside_m = all_W.max.x() + 60;
  add_statuses("static_status", drive->scene);
  add_statuses("fused_status", WithObjects(*drive->scene, 64, {beside_m, 0, 0}));
  add_statuses("fused_status_among", WithObjects(*drive->scene, 64, all_W.Center()));
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(
      argc, argv, clearway::bench::Register,
      {{"lookup_random_vs_octomap_x", "octomap_random", "clearway_random"},
       {"lookup_coherent_vs_octomap_x", "octomap_coherent", "clearway_coherent"},
       {"lookup_fused_cost_x", "fused_status", "static_status"},
       {"lookup_fused_among_cost_x", "fused_status_among", "static_status"}},
      clearway::bench::Order::kInTurns);
}
