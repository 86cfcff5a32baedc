// How the cost of integration, lookup and collision grows: with points, range, resolution, moving
// objects, and the length of a drive. Each value is a counter of its own, `curve_<what>_<x>`.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "clearway/scene/scene_builder.h"
#include "clearway/scene/scene_delta.h"
#include "costs.h"
#include "drive_map.h"
#include "long_drive.h"
#include "recorded_scans.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr double kNoLimit_m = -1;

SceneParams Params(double resolution_m, double range_m) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = resolution_m;
  params.rays = {range_m, false};
  return params;
}

std::vector<Frame> Thinned(std::vector<Frame> frames, std::size_t one_of) {
  for (Frame& frame : frames) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < frame.points_S.size(); i += one_of, ++kept) {
      frame.points_S[kept] = frame.points_S[i];
      frame.labels[kept] = frame.labels[i];
    }
    frame.points_S.resize(kept);
    frame.labels.resize(kept);
  }
  return frames;
}

// Where robots drive: 20 m around the sensor, a few metres high.
Aabb Around(const Eigen::Vector3d& center_W) {
  return {center_W - Eigen::Vector3d(20, 20, 2.5), center_W + Eigen::Vector3d(20, 20, 2.5)};
}

using Counters = benchmark::UserCounters;

// Of scans with these parameters: integration, lookups anywhere in their map, checks around the
// sensor.
void Scans(Counters& counters, const std::string& x, const std::vector<Frame>& scans,
           const SceneParams& params) {
  const ScenePtr scene = SceneOf(scans, params);
  counters["curve_integrate_ms_" + x] = IntegrateMs(scans, params);
  counters["curve_lookup_ns_" + x] = LookupNs(*scene, scene->static_map_W.ObservedBox());
  counters["curve_check_ns_" + x] = CheckNs(scene, Around(scans.front().T_W_S.translation));
}

void Points(Counters& counters, const std::vector<Frame>& scans) {
  for (const std::size_t one_of : {16, 8, 4, 2, 1}) {
    const std::vector<Frame> frames = Thinned(scans, one_of);
    Scans(counters, "points_" + std::to_string(frames[0].points_S.size()), frames, Params(0.1, 50));
  }
}

void Ranges(Counters& counters, const std::vector<Frame>& scans) {
  for (const int range_m : {10, 20, 30, 50, 80}) {
    Scans(counters, "range_m_" + std::to_string(range_m), scans, Params(0.1, range_m));
  }
}

void Resolutions(Counters& counters, const std::vector<Frame>& scans) {
  for (const int resolution_mm : {400, 200, 100, 50}) {
    Scans(counters, "resolution_mm_" + std::to_string(resolution_mm), scans,
          Params(1e-3 * resolution_mm, 50));
  }
}

// Objects in the midst of the map, of 8 points each: queries near the sensor, where at most 64 of
// them are, and anywhere among them; and frames of them alone.
void Objects(Counters& counters, const std::vector<Frame>& scans) {
  const ScenePtr alone = SceneOf(scans, Params(0.1, 50));
  const Eigen::Vector3d center_W = scans.front().T_W_S.translation;
  for (const int count : {0, 1, 10, 100, 300, 1000}) {
    const ScenePtr scene = count == 0 ? alone : WithObjects(*alone, count, center_W);
    const std::string x = "objects_" + std::to_string(count);
    counters["curve_lookup_ns_" + x] = LookupNs(*scene, Around(center_W));
    counters["curve_check_ns_" + x] = CheckNs(scene, Around(center_W));
    if (count == 0) continue;
    const Aabb crowd_W = CrowdBox(count, center_W);
    counters["curve_lookup_among_ns_" + x] = LookupNs(*scene, crowd_W);
    counters["curve_check_among_ns_" + x] = CheckNs(scene, crowd_W);
    counters["curve_integrate_ms_" + x] =
        IntegrateMs(FramesWithObjects(scene->stamp, count, center_W, 4), Params(0.1, kNoLimit_m));
  }
}

// A scan at the end of drives of several lengths: what it costs there, and what its delta does.
// `keep_distance_m` 0: all is kept.
void Lengths(Counters& counters, const std::string& prefix, double keep_distance_m, bool quick) {
  SceneParams params = Params(0.1, 30);
  params.keep_distance_m = keep_distance_m;
  LongDrive drive;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  ScenePtr before;
  for (const int length_m :
       quick ? std::vector{100, 240, 480} : std::vector{100, 480, 1000, 2500, 5000}) {
    while (drive.driven_m() < length_m) {
      if (!builder.Apply(drive.Next()).ok()) std::abort();
      before = builder.Publish();
    }
    ScenePtr after;
    const Frame frame = drive.Next();
    const double apply_ms = Took<std::milli>([&] {
      if (!builder.Apply(frame).ok()) std::abort();
      after = builder.Publish();
    });
    SceneDelta delta;
    const double diff_ms = Took<std::milli>([&] { delta = Diff(&*before, *after); });
    absl::StatusOr<SceneSnapshot> mirrored;
    const double apply_delta_ms = Took<std::milli>([&] { mirrored = Apply(&*before, delta); });
    if (!mirrored.ok()) std::abort();
    const auto blocks = static_cast<double>(delta.static_map_W.size());
    const auto set = [&](const std::string& what, double value) {
      counters["curve_" + what + "_" + prefix + "drive_m_" + std::to_string(length_m)] = value;
    };
    set("changed_blocks", blocks);
    set("integrate_us_per_block", 1e3 * apply_ms / blocks);
    set("diff_us_per_block", 1e3 * diff_ms / blocks);
    set("apply_delta_us_per_block", 1e3 * apply_delta_ms / blocks);
    set("lookup_ns", LookupNs(*after, after->static_map_W.ObservedBox()));
    set("check_ns", CheckNs(after, Around(frame.T_W_S.translation)));
    set("map_mb", 1e-6 * static_cast<double>(after->static_map_W.blocks().MemoryBytes()));
    before = after;
  }
}

void Register(const Effort& effort) {
  const auto scans = std::make_shared<std::vector<Frame>>(WholeScans(effort.quick ? 3 : 6));
  const auto add = [&](const std::string& name, auto run) {
    Add(name, effort, [=](benchmark::State& state) {
      for (auto _ : state) run(state.counters);
    });
  };
  add("points", [=](Counters& counters) { Points(counters, *scans); });
  add("ranges", [=](Counters& counters) { Ranges(counters, *scans); });
  add("resolutions", [=](Counters& counters) { Resolutions(counters, *scans); });
  add("objects", [=](Counters& counters) { Objects(counters, *scans); });
  const bool quick = effort.quick;
  add("lengths", [=](Counters& counters) { Lengths(counters, "", 0, quick); });
  add("lengths_rolling", [=](Counters& counters) { Lengths(counters, "rolling_", 60, quick); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
