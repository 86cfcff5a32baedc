// How things that are not rigid are predicted: a truck and its trailer, pedalling cyclists, an
// excavator (the simulator's `articulated`), whose parts are told to be parts of one object; told
// as objects of their own; and not told, so that each whole is taken for rigid.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clearway/report/prediction_score.h"
#include "clearway/report/surface_judge.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/missed_objects.h"
#include "clearway/sim/scenarios.h"
#include "summary.h"

namespace clearway::bench {
namespace {

using Retell = std::function<Frame(Frame)>;

const std::vector<std::pair<Duration, std::string>> kAhead = {
    {std::chrono::milliseconds(500), "0.5s"},
    {std::chrono::seconds(1), "1s"},
    {std::chrono::seconds(2), "2s"}};

std::vector<Duration> Aheads() {
  std::vector<Duration> ahead;
  for (const auto& [duration, name] : kAhead) ahead.push_back(duration);
  return ahead;
}

Frame AsTold(Frame frame) { return frame; }
Frame Apart(Frame frame) {
  frame.parts.clear();
  return frame;
}

void Predict(const Retell& retell, const ScenarioOptions& options, const std::string& suffix,
             benchmark::State& state) {
  const Simulation simulation = *MakeScenario("articulated", options);
  SceneParams params;
  params.resolution_m = params.object_resolution_m = simulation.spec().resolution_m;
  params.rays.max_range_m = 50;
  params.motion = MotionModel::kTrack;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  SurfaceJudge judge(simulation, Aheads());
  PredictionScore score(TruthOf(std::make_shared<const World>(simulation.world()),
                                simulation.StampOf(simulation.frame_count() - 1)),
                        Aheads());
  for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
    const Frame frame = simulation.MakeFrame(k);
    if (!builder.Apply(retell(frame)).ok()) std::abort();
    judge.Add(k, frame, *builder.Publish());
    score.Add(*builder.Publish());
  }
  const World& world = simulation.world();
  for (std::size_t i = 0; i < kAhead.size(); ++i) {
    const std::string name = "_" + kAhead[i].second + suffix;
    SolidOverlap all;
    for (const auto& [id, overlaps] : judge.overlaps()) {
      const bool has_parts = !world.PartsOf(id).empty();
      if (has_parts || world.FindObject(id)->part_of != kStaticLabel) all += overlaps[i];
    }
    state.counters["articulated_solids_f" + name] = all.FScore();
    PredictionErrors parts;
    parts.ahead = kAhead[i].first;
    for (const auto& [id, errors] : score.Errors()) {
      if (world.FindObject(id)->part_of != kStaticLabel) parts += errors[i];
    }
    if (parts.errors_m.empty()) continue;
    state.counters["articulated_parts_m" + name] = parts.Median();
    state.counters["articulated_parts_within" + name] = parts.Within();
  }
}

void Register(const Effort& effort) {
  Effort once = effort;
  once.repetitions = 1;
  ScenarioOptions options;
  if (effort.quick) options.frame_count = 60;
  Add("articulated", once, [=](auto& state) {
    for (auto _ : state) {
      Predict(AsTold, options, "", state);
      Predict(Apart, options, "_apart", state);
      Predict(WithoutParts, options, "_one", state);
    }
  });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
