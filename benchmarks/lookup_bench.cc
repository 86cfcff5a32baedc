// Points looked up in the static map against OctoMap's search: at random, and one voxel after the
// other along lines. And what moving objects elsewhere add to a point's status at its own time.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <span>

#include "clearway/map/voxel_reader.h"
#include "clearway/scene/timed_scene.h"
#include "drive_map.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr double kTurn_s = 0.1;  // of one benchmark, before another's

using Points = std::vector<Eigen::Vector3d>;
using LookUp = std::function<void(std::span<const Eigen::Vector3d>, std::span<VoxelState>)>;

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

LookUp ByOctomap(const std::shared_ptr<const octomap::OcTree>& tree) {
  return [tree](const auto& points_W, const auto& states) {
    for (std::size_t i = 0; i < points_W.size(); ++i) states[i] = StateIn(*tree, points_W[i]);
  };
}

LookUp ByClearway(const DriveMap& drive) {
  const auto reader = std::make_shared<VoxelReader>(drive.scene->static_map_W);
  return [scene = drive.scene, reader](const auto& points_W, const auto& states) {
    reader->States(points_W, states);
  };
}

void ExpectOctomaps(benchmark::State& state, const DriveMap& drive, const Points& points_W,
                    const std::vector<VoxelState>& states) {
  std::vector<VoxelState> expected(points_W.size());
  ByOctomap(drive.tree)(points_W, expected);
  if (states != expected) state.SkipWithError("OctoMap disagrees");
}

// Points that wait in memory, all at once.
void FromMemory(benchmark::State& state, const DriveMap& drive, const LookUp& look_up,
                const Points& points_W) {
  std::vector<VoxelState> states(points_W.size());
  for (auto _ : state) {
    look_up(points_W, states);
    benchmark::DoNotOptimize(states.data());
  }
  ExpectOctomaps(state, drive, points_W, states);
}

// A batch of points after the other, put down just before it is looked up, as by one who makes them
// then. The lookups alone are timed.
void InBatches(benchmark::State& state, const DriveMap& drive, const LookUp& look_up,
               const Points& points_W) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kBatch = 1000;
  Points batch(kBatch);
  std::vector<VoxelState> states(points_W.size());
  for (auto _ : state) {
    Clock::duration took{};
    for (std::size_t begin = 0; begin < points_W.size(); begin += kBatch) {
      std::copy_n(points_W.begin() + begin, kBatch, batch.begin());
      const auto start = Clock::now();
      look_up(batch, std::span(states).subspan(begin, kBatch));
      took += Clock::now() - start;
    }
    state.SetIterationTime(std::chrono::duration<double>(took).count());
  }
  ExpectOctomaps(state, drive, points_W, states);
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

using Run = std::function<void(benchmark::State&)>;

auto* AddTurns(const Effort& effort, const std::string& name, const Run& run) {
  return benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->MinTime(kTurn_s)
      ->Repetitions(3 * effort.repetitions)
      ->ReportAggregatesOnly();
}

void Register(const Effort& effort) {
  constexpr std::size_t kPoints = 1'000'000;
  const auto drive = std::make_shared<DriveMap>(MakeDriveMap(effort.quick ? 5 : 20));
  const Aabb all_W = drive->scene->static_map_W.ObservedBox();
  const Points random = RandomPoints(all_W, kPoints);
  const std::vector<std::pair<std::string, LookUp>> who_looks_up = {
      {"octomap_", ByOctomap(drive->tree)},
      {"octomap_read_", ByOctomap(drive->read_tree)},
      {"clearway_", ByClearway(*drive)}};
  const auto add = [&](const std::string& name, auto run, const Points& points) {
    for (const auto& [who, look_up] : who_looks_up) {
      auto* const added = AddTurns(effort, who + name, [=, look_up = look_up](auto& state) {
        run(state, *drive, look_up, points);
      });
      if (run == InBatches) added->UseManualTime();
    }
  };
  add("random", FromMemory, random);
  add("coherent", InBatches, PointsOnLines(drive->box_W, kPoints));
  add("coherent_anywhere", InBatches, PointsOnLines(all_W, kPoints));
  add("coherent_from_memory", FromMemory, PointsOnLines(drive->box_W, kPoints));
  const auto add_statuses = [&](const std::string& name, const ScenePtr& scene) {
    AddTurns(effort, name, [=](auto& state) { Statuses(state, *scene, random); });
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
       {"lookup_random_read_vs_octomap_x", "octomap_read_random", "clearway_random"},
       {"lookup_coherent_vs_octomap_x", "octomap_coherent", "clearway_coherent"},
       {"lookup_coherent_read_vs_octomap_x", "octomap_read_coherent", "clearway_coherent"},
       {"lookup_coherent_anywhere_vs_octomap_x", "octomap_coherent_anywhere",
        "clearway_coherent_anywhere"},
       {"lookup_coherent_from_memory_vs_octomap_x", "octomap_coherent_from_memory",
        "clearway_coherent_from_memory"},
       {"lookup_fused_cost_x", "fused_status", "static_status"},
       {"lookup_fused_among_cost_x", "fused_status_among", "static_status"}},
      clearway::bench::Order::kInTurns);
}
