// Scans into maps, against OctoMap's insertPointCloud with the same range: whole scans of a real
// drive into the static map (every ray, one ray per end voxel, two threads), a labelled drive with
// its moving objects, and depth images. Ours includes a frame's checks and the publication of a
// version after each scan, while a reader still holds the one before; its memory has been in use
// before, as a server's has that runs.
#include <benchmark/benchmark.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "costs.h"
#include "recorded_scans.h"
#include "summary.h"

namespace clearway::bench {
namespace {

struct Input {
  std::vector<Frame> frames;
  double resolution_m;
  double range_m;  // -1: no limit
};
using InputPtr = std::shared_ptr<const Input>;

const std::string kWhole = "whole";

double MapsMb(const SceneSnapshot& scene) {
  std::size_t bytes = scene.static_map_W.blocks().MemoryBytes();
  for (const auto& object : scene.objects) bytes += object->map_O.blocks().MemoryBytes();
  return static_cast<double>(bytes) / 1e6;
}

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

std::vector<octomap::Pointcloud> CloudsOf(const Input& input) {
  std::vector<octomap::Pointcloud> clouds;
  for (const Frame& frame : input.frames) {
    octomap::Pointcloud& cloud = clouds.emplace_back();
    for (const Eigen::Vector3f& p : PointsInWorld(frame)) cloud.push_back(p.x(), p.y(), p.z());
  }
  return clouds;
}

struct OctomapCost {
  double ms = 0;         // all scans into a new tree, its end included
  double memory_mb = 0;  // of the pruned tree
};

OctomapCost Octomap(const Input& input, const std::vector<octomap::Pointcloud>& clouds,
                    bool discretize) {
  OctomapCost cost;
  auto tree = std::make_unique<octomap::OcTree>(input.resolution_m);
  cost.ms = Took<std::milli>([&] {
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      const Eigen::Vector3f origin = input.frames[i].T_W_S.translation.cast<float>();
      tree->insertPointCloud(clouds[i], {origin.x(), origin.y(), origin.z()}, input.range_m, false,
                             discretize);
    }
  });
  tree->prune();
  cost.memory_mb = static_cast<double>(tree->memoryUsage()) / 1e6;
  cost.ms += Took<std::milli>([&] { tree.reset(); });
  return cost;
}

SceneParams ParamsFor(const Input& input, bool discretize) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = input.resolution_m;
  params.rays = {.max_range_m = input.range_m, .discretize = discretize, .octomap_ends = true};
  return params;
}

// With all that makes maps and predictions better.
SceneParams RobustParamsFor(const Input& input) {
  SceneParams params = ParamsFor(input, false);
  params.rays.grazing_m = 4;
  params.motion = MotionModel::kTrack;
  params.solid = SolidMode::kCompletedHull;
  params.rest_distance_m = 0.6;
  params.object_pose_error_m = 0.1;
  params.object_pose_error_rad = 0.02;
  params.reidentify = true;
  params.filter_labels = true;
  params.dynamic_life = std::chrono::milliseconds(500);
  return params;
}

// Takes frames and publishes a version after each, while a reader still holds the one before.
class Integrator {
 public:
  Integrator(const SceneParams& params, int threads)
      : pool_(threads), builder_(params, {}, pool_) {}

  void Take(const Frame& frame) {
    if (!builder_.Apply(frame).ok()) throw std::runtime_error("a frame was refused");
    const auto integrated = Clock::now();
    ScenePtr published = builder_.Publish();
    publishing_ = std::max<Milliseconds>(publishing_, Clock::now() - integrated);
    held_ = std::move(published);
  }
  // Back to empty maps, with the memory of what it has taken.
  void Reset() {
    builder_.Reset();
    held_ = builder_.Publish();  // the end of the maps before, which no scan shall pay for
  }

  double publish_ms() const { return publishing_.count(); }
  const SceneSnapshot& scene() const { return *held_; }

 private:
  ThreadPool pool_;
  SceneBuilder builder_;
  ScenePtr held_;
  Milliseconds publishing_{0};  // the longest from an integration's end to the version
};

// Has taken the frames once: what a process pays for its first scans alone is not counted.
std::unique_ptr<Integrator> WarmIntegrator(const Input& input, const SceneParams& params,
                                           int threads) {
  auto integrator = std::make_unique<Integrator>(params, threads);
  for (const Frame& frame : input.frames) integrator->Take(frame);
  return integrator;
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Milliseconds of all frames, the end of the maps before included: the median of a few rounds.
double FramesMs(Integrator& integrator, const Input& input) {
  std::vector<double> rounds_ms(5);
  for (double& ms : rounds_ms) {
    ms = Took<std::milli>([&] {
      integrator.Reset();
      for (const Frame& frame : input.frames) integrator.Take(frame);
    });
  }
  return Median(rounds_ms);
}

// Likewise, but of each frame the median: what disturbs some of a round's frames leaves the others.
class FrameByFrame {
 public:
  FrameByFrame(const Input& input, const SceneParams& params)
      : input_(input), integrator_(WarmIntegrator(input, params, 1)) {}

  void TakeRound() {
    took_ms_.resize(input_.frames.size() + 1);
    took_ms_.back().push_back(Took<std::milli>([&] { integrator_->Reset(); }));
    for (std::size_t i = 0; i < input_.frames.size(); ++i) {
      took_ms_[i].push_back(Took<std::milli>([&] { integrator_->Take(input_.frames[i]); }));
    }
  }
  double FramesMs() const {
    double sum_ms = 0;
    for (const std::vector<double>& rounds_ms : took_ms_) sum_ms += Median(rounds_ms);
    return sum_ms;
  }

 private:
  const Input& input_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<std::vector<double>> took_ms_;  // by frame and round; last, the end of the maps
};

// The same frames with OctoMap and with ours, in turn: what disturbs one disturbs the other.
void AgainstOctomap(benchmark::State& state, const Input& input, const std::string& name,
                    bool discretize) {
  const std::vector<octomap::Pointcloud> clouds = CloudsOf(input);
  const auto integrator = WarmIntegrator(input, ParamsFor(input, discretize), 1);
  for (auto _ : state) {
    const OctomapCost octomap = Octomap(input, clouds, discretize);
    const double ours_ms = FramesMs(*integrator, input);
    state.counters["octomap_" + name + "_ms"] = octomap.ms;
    state.counters["clearway_" + name + "_ms"] = ours_ms;
    const std::string ratio =
        name == kWhole ? "integrate_vs_octomap_x" : "integrate_" + name + "_vs_octomap_x";
    state.counters[ratio] = octomap.ms / ours_ms;
    if (name != kWhole) continue;
    state.counters["publish_ms"] = integrator->publish_ms();
    state.counters["memory_vs_octomap_x"] = octomap.memory_mb / MapsMb(integrator->scene());
  }
}

// Likewise with one thread and with two.
void OneAndTwoThreads(benchmark::State& state, const Input& input) {
  const SceneParams params = ParamsFor(input, false);
  const auto one = WarmIntegrator(input, params, 1), two = WarmIntegrator(input, params, 2);
  const auto scans = static_cast<double>(input.frames.size());
  for (auto _ : state) {
    const double one_ms = FramesMs(*one, input), two_ms = FramesMs(*two, input);
    state.counters["scan_1thread_ms"] = one_ms / scans;
    state.counters["scan_2threads_ms"] = two_ms / scans;
    state.counters["integrate_2threads_x"] = one_ms / two_ms;
    if (!SameContent(one->scene(), two->scene())) state.SkipWithError("the maps differ");
  }
}

// The same frames with the options and without, in turn. They differ by less than what a machine's
// speed changes by within seconds.
void RobustAndPlain(benchmark::State& state, const Input& input, const std::string& name) {
  constexpr int kRounds = 9;
  for (auto _ : state) {
    FrameByFrame plain(input, ParamsFor(input, false)), robust(input, RobustParamsFor(input));
    for (int round = 0; round < kRounds; ++round) {
      plain.TakeRound();
      robust.TakeRound();
    }
    state.counters["integrate_robust_" + name + "_x"] = plain.FramesMs() / robust.FramesMs();
  }
}

void Register(Effort effort) {
  effort.repetitions = std::min(effort.repetitions, 5);  // OctoMap takes minutes for each
  const auto whole = std::make_shared<Input>(WholeScans(effort.quick ? 3 : 20), 0.1, 50);
  const auto fov = std::make_shared<Input>(LabelledScans(effort.quick ? 5 : 20), 0.1, 50);
  const auto depth = std::make_shared<Input>(DepthFrames(effort.quick ? 2 : 10), 0.05, -1);
  const auto against_octomap = [&](const std::string& name, const InputPtr& input,
                                   bool discretize) {
    Add(name, effort, [=](auto& state) { AgainstOctomap(state, *input, name, discretize); });
  };
  against_octomap(kWhole, whole, false);
  against_octomap("discrete", whole, true);
  against_octomap("fov", fov, false);
  against_octomap("depth", depth, false);
  Add("robust_whole", effort, [=](auto& state) { RobustAndPlain(state, *whole, "whole"); });
  Add("robust_fov", effort, [=](auto& state) { RobustAndPlain(state, *fov, "fov"); });
  Add("threads", effort, [=](auto& state) { OneAndTwoThreads(state, *whole); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {},
                               clearway::bench::Order::kInTurns);
}
