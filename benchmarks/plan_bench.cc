// Planning in space-time on the data folder's worlds of moving discs, on which OMPL's ST-RRT* was
// measured: the discs are given objects with given futures of an ordinary scene, the robot is a
// disc of at most 1 m/s, and every motion and wait of a plan is proved. Each plan is then judged by
// the discs' own motion.
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "clearway/planning/space_time_setup.h"
#include "clearway/scene/scene_builder.h"
#include "disc_worlds.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Disc = DiscWorld::Disc;

constexpr double kBudget_s = 1;

Pose PoseOf(const Disc& disc, double seconds) {
  const Eigen::Vector2d p_m = disc.At(seconds);
  return Pose::Translation(p_m.x(), p_m.y(), 0);
}

ScenePtr SceneOf(const DiscWorld& world) {
  ThreadPool pool(1);
  SceneBuilder builder(SceneParams{}, FrameLimits{}, pool);
  std::vector<GivenObject> given;
  for (const Disc& disc : world.objects) {
    GivenObject& object = given.emplace_back();
    object.id = static_cast<ObjectId>(given.size());
    object.shape = Cylinder{disc.radius_m, 1};
    object.pose = {Time(), PoseOf(disc, 0)};
    for (const double turn_s : disc.Turns()) {
      const StampedPose pose{Time() + FromSeconds(turn_s), PoseOf(disc, turn_s)};
      const Time before = object.future.empty() ? Time() : object.future.back().stamp;
      if (pose.stamp > before) object.future.push_back(pose);
    }
  }
  if (const auto status = builder.AddObjects(given); !status.ok()) {
    std::fprintf(stderr, "%s\n", status.ToString().c_str());
    std::abort();
  }
  return builder.Publish();
}

// The least gap between robot and discs along the path, every millisecond, from the discs' own
// motion.
double LeastGap_m(const DiscWorld& world, const og::PathGeometric& path) {
  double least_m = std::numeric_limits<double>::infinity();
  const auto* space = path.getSpaceInformation()->getStateSpace().get();
  ob::State* const state = space->allocState();
  for (std::size_t i = 1; i < path.getStateCount(); ++i) {
    const ob::State *from = path.getState(i - 1), *to = path.getState(i);
    const double from_s = SpaceTimeStateSpace::SecondsOf(from);
    const double lasts_s = SpaceTimeStateSpace::SecondsOf(to) - from_s;
    const int steps = std::max(1, static_cast<int>(std::ceil(1000 * lasts_s)));
    for (int k = 0; k <= steps; ++k) {
      space->interpolate(from, to, static_cast<double>(k) / steps, state);
      const auto& p =
          *SpaceTimeStateSpace::SpacePart(state)->as<ob::RealVectorStateSpace::StateType>();
      const double seconds = from_s + lasts_s * k / steps;
      for (const Disc& disc : world.objects) {
        const double apart_m = (disc.At(seconds) - Eigen::Vector2d(p[0], p[1])).norm();
        least_m = std::min(least_m, apart_m - disc.radius_m - DiscWorld::kRobotRadius_m);
      }
    }
  }
  space->freeState(state);
  return least_m;
}

struct Outcome {
  bool solved = false;
  double first_ms = 0, arrival_s = 0, gap_m = 0;
};

Outcome PlanIn(const DiscWorld& world) {
  auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  plane->setBounds(0, DiscWorld::kSide_m);
  const auto space = std::make_shared<SpaceTimeStateSpace>(
      plane, SpeedLimits{DiscWorld::kRobotSpeed_mps, 1}, FromSeconds(DiscWorld::kLatest_s));
  const auto checker = std::make_shared<SceneChecker>(
      SceneOf(world), Robot::SingleShape("disc", Cylinder{DiscWorld::kRobotRadius_m, 1}));
  PlanningOptions options;
  options.check.unknown = UnknownPolicy::kFree;
  options.contact_resolution_m = 0.1;  // to go on it is enough to know of a contact
  Ground ground;
  ground.clearance_m = -0.5;  // the discs' centres are at height 0
  ob::ScopedState<> start(space), goal(space);
  start = std::vector<double>{DiscWorld::kStart_m, DiscWorld::kStart_m, 0};
  goal = std::vector<double>{DiscWorld::kGoal_m, DiscWorld::kGoal_m, 0};
  const auto setup = MakeSpaceTimeSetup(
      space, checker, StateMapping::R2(checker->robot(), ground, TimeSince{Time()}), options,
      start.get(), SpaceTimeStateSpace::SpacePart(goal.get()), {.tolerance = 0.01});
  if (!setup.ok()) return {};
  Outcome outcome;
  const auto begin = std::chrono::steady_clock::now();
  (*setup)->getProblemDefinition()->setIntermediateSolutionCallback(
      [&](const ob::Planner*, const std::vector<const ob::State*>&, ob::Cost) {
        if (outcome.solved) return;
        outcome.solved = true;
        outcome.first_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
                .count();
      });
  (*setup)->solve(kBudget_s);
  if (!outcome.solved) return outcome;
  const og::PathGeometric& path = (*setup)->getSolutionPath();
  outcome.arrival_s = SpaceTimeStateSpace::SecondsOf(path.getState(path.getStateCount() - 1));
  outcome.gap_m = LeastGap_m(world, path);
  return outcome;
}

double Median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::infinity();
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

// Says why a world was not solved.
bool HasNoSolution(std::size_t index, const DiscWorld& world) {
  std::fprintf(stderr, "world %zu, of %d discs: not solved", index, world.discs);
  const std::optional<double> after_s = NobodyIsLeftAfter(world);
  if (after_s) {
    std::fprintf(stderr, "; it has no solution: wherever the robot goes, it is met by %.1f s",
                 *after_s);
  }
  std::fprintf(stderr, "\n");
  return after_s.has_value();
}

// By the number of discs, of worlds that have a solution.
struct Tally {
  std::map<int, std::vector<double>> first_ms, arrival_s;  // of those that were solved
  std::map<int, int> worlds, solved;
};

Tally PlanInAll(benchmark::State& state, const std::vector<DiscWorld>& worlds) {
  Tally tally;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const int discs = worlds[w].discs;
    const Outcome outcome = PlanIn(worlds[w]);
    if (!outcome.solved && HasNoSolution(w, worlds[w])) continue;
    ++tally.worlds[discs];
    if (!outcome.solved) continue;
    ++tally.solved[discs];
    tally.first_ms[discs].push_back(outcome.first_ms);
    tally.arrival_s[discs].push_back(outcome.arrival_s);
    if (outcome.gap_m <= 0) state.SkipWithError("a plan touches a disc");
  }
  return tally;
}

// Each world once in a round: another one has other random places. Times are the medians of the
// rounds' medians; of the solved ones those of all rounds are counted.
void Discs(benchmark::State& state, const std::vector<DiscWorld>& worlds, int rounds) {
  for (auto _ : state) {
    std::map<int, std::vector<double>> first_ms, arrival_s;
    std::map<int, int> worlds_of, solved_of;
    for (int round = 0; round < rounds; ++round) {
      Tally tally = PlanInAll(state, worlds);
      for (const auto& [discs, count] : tally.worlds) {
        worlds_of[discs] += count;
        solved_of[discs] += tally.solved[discs];
        first_ms[discs].push_back(Median(tally.first_ms[discs]));
        arrival_s[discs].push_back(Median(tally.arrival_s[discs]));
      }
    }
    double all = 0, solved = 0;
    for (const auto& [discs, count] : worlds_of) {
      const std::string of = "_" + std::to_string(discs);
      all += count;
      solved += solved_of[discs];
      state.counters["discs_solved" + of + "_fraction"] =
          static_cast<double>(solved_of[discs]) / count;
      state.counters["discs_first" + of + "_ms"] = Median(first_ms[discs]);
      state.counters["discs_arrival" + of + "_s"] = Median(arrival_s[discs]);
    }
    state.counters["discs_solved_fraction"] = solved / all;
  }
}

void Register(const Effort& effort) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  const auto file = DataPath("discs/worlds.json");
  if (!file) return;  // it has said so
  const auto worlds = std::make_shared<std::vector<DiscWorld>>(ReadDiscWorlds(*file));
  Effort once = effort;
  once.repetitions = 1;
  const int rounds = effort.quick ? 2 : 3;
  Add("discs", once, [=](auto& state) { Discs(state, *worlds, rounds); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
