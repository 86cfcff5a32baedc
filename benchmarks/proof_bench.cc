// What CheckMotions calls free, tried: random motions of random robots in random moving scenes and
// in a scene of the real drive, each of which a part is called free at 200 times of that, placed
// where the robot is closest to anything, and one in a hundred at 10,000 times. None may be in
// contact.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>

#include "clearway/collision/scene_checker.h"
#include "clearway/scene/scene_builder.h"
#include "collision/motion_proof.h"
#include "collision/random_motions.h"
#include "collision/random_world.h"
#include "recorded_scans.h"
#include "summary.h"

namespace clearway::bench {
namespace {

constexpr int kTimes = 200, kEvery = 100, kAtOnce = 25;

ScenePtr RealScene() {
  ThreadPool pool(1);
  SceneParams params;
  params.rays.max_range_m = 40;
  SceneBuilder builder(params, {}, pool);
  for (const Frame& frame : LabelledScans(20)) {
    if (!builder.Apply(frame).ok()) std::abort();
  }
  return builder.Publish();
}

// Motions as in the random scenes, carried to near one of the scene's objects and to its time.
void MoveNear(const SceneSnapshot& scene, RandomWorld& random, Asked& asked) {
  std::size_t first = 0;
  for (const std::size_t knots : asked.motions.knot_counts) {
    const auto& object = *scene.objects[random.Below(static_cast<int>(scene.objects.size()))];
    const Eigen::Vector3d by_W = object.history.back().T_W_O.translation +
                                 random.Point({{-6, -6, -0.5}, {6, 6, 1.5}}) -
                                 asked.motions.T_W_L[first * asked.links].translation;
    const Duration later =
        scene.stamp + FromSeconds(random.Uniform(0, 4)) - asked.motions.times[first];
    for (std::size_t k = first; k < first + knots; ++k) {
      asked.motions.times[k] += later;
      for (std::size_t l = 0; l < asked.links; ++l) {
        asked.motions.T_W_L[k * asked.links + l].translation += by_W;
      }
    }
    first += knots;
  }
}

// Each repetition has its own motions: `seed` goes on.
void Try(benchmark::State& state, const ScenePtr& real, int looked_at, std::uint32_t& seed) {
  for (auto _ : state) {
    ProofCounts counts;
    for (; counts.looked_at < looked_at; ++seed) {
      RandomWorld random(seed);
      const ScenePtr scene = real != nullptr ? real : random.Scene();
      const Robot robot = random.AnyRobot();
      const SceneChecker checker(scene, robot);
      Asked asked = RandomMotions(random, robot, kAtOnce);
      if (real != nullptr) MoveNear(*scene, random, asked);
      TryProofs(checker, asked, RandomMotionOptions(random, robot), kTimes, kEvery, counts);
    }
    const std::string of = real != nullptr ? "proof_real" : "proof_random";
    state.counters[of + "_motions"] = counts.motions;
    state.counters[of + "_looked_at"] = counts.looked_at;
    state.counters[of + "_looked_closely"] = counts.looked_closely;
    state.counters[of + "_free_motions"] = counts.free;
    state.counters[of + "_states"] = static_cast<double>(counts.states);
    state.counters[of + "_free_in_contact"] = counts.free_in_contact;
    state.counters[of + "_witnesses_free"] = counts.witnesses_free;
    state.counters[of + "_unresolved_fraction"] =
        static_cast<double>(counts.unresolved) / counts.motions;
    if (counts.free_in_contact > 0) state.SkipWithError("a motion called free is in contact");
    if (counts.witnesses_free > 0) state.SkipWithError("a witness is free");
  }
}

void Register(const Effort& effort) {
  Effort twice = effort;
  twice.repetitions = 2;
  const ScenePtr real = RealScene();
  const int in_random = effort.quick ? 1'000 : 40'000, in_real = effort.quick ? 500 : 10'000;
  const auto seed = std::make_shared<std::uint32_t>(90'000);
  Add("proofs_in_random_scenes", twice,
      [=](auto& state) { Try(state, nullptr, in_random, *seed); });
  Add("proofs_in_the_real_scene", twice, [=](auto& state) { Try(state, real, in_real, *seed); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
