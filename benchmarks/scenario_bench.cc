// The scenarios of examples/scenarios: SafeIntervalPlanner and OMPL's RRT, RRTConnect and RRT* over
// the same space, checks and time. Each plan is judged by the file's own motions. One alone:
// --benchmark_filter=highway --out /tmp/alone, which leaves the summary of all as it is.
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "clearway/planning/safe_interval_planner.h"
#include "clearway/planning/solve_task.h"
#include "clearway/planning/space_information.h"
#include "clearway/planning/task_setup.h"
#include "clearway/scene/scene_builder.h"
#include "cli/scenario_file.h"
#include "planner_runs.h"
#include "scenario_truth.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

namespace og = ompl::geometric;

constexpr double kBudget_s = 1;
constexpr std::chrono::milliseconds kLook(20);
const std::filesystem::path kRoot(CLEARWAY_SOURCE_DIR);

struct RunCounts {
  unsigned int ours, others;
};

// One who does not see what moves.
enum class Sees { kAll, kWhatRests };

std::shared_ptr<const SceneChecker> CheckerOf(const cli::Scenario& scenario, Sees sees) {
  ThreadPool pool(1);
  SceneBuilder builder(SceneParams{}, FrameLimits{}, pool);
  for (const GivenObject& object : scenario.objects) {
    const bool moves = object.velocity_O || !object.future.empty();
    if (sees == Sees::kWhatRests && moves) continue;
    if (const auto status = builder.AddObject(object); !status.ok()) {
      std::fprintf(stderr, "%s: %s\n", scenario.name.c_str(), status.ToString().c_str());
      std::abort();
    }
  }
  return std::make_shared<SceneChecker>(builder.Publish(), scenario.robot);
}

og::SimpleSetupPtr SetupOf(const cli::Scenario& scenario, Sees sees) {
  const auto setup = MakeTaskSetup(scenario.task, CheckerOf(scenario, sees));
  if (setup.ok()) return *setup;
  std::fprintf(stderr, "%s: %s\n", scenario.name.c_str(), setup.status().ToString().c_str());
  std::abort();
}

bool Touches(const World& truth, const cli::Scenario& scenario, const og::PathGeometric& path) {
  const StateMapping& mapping = QueryOf(*path.getSpaceInformation())->mapping();
  return FirstTouched(truth, scenario.robot, path, mapping, kLook).has_value();
}

// Whether a plan that ignores what moves meets something.
bool IsNotVoid(const cli::Scenario& scenario) {
  const og::SimpleSetupPtr setup = SetupOf(scenario, Sees::kWhatRests);
  setup->setup();
  setup->getPlanner()->solve(ompl::base::timedPlannerTerminationCondition(kBudget_s));
  return setup->haveExactSolutionPath() &&
         Touches(TruthOf(scenario), scenario, setup->getSolutionPath());
}

struct Result {
  std::string planner;
  double solved_fraction;
  MedianInterval first_s, arrival_s;
  int touching = 0;
};

Result Run(const cli::Scenario& scenario, const std::string& file, const World& truth,
           og::SimpleSetup& setup, const ompl::base::PlannerPtr& planner, unsigned int runs) {
  Result result;
  result.planner = planner->getName();
  const auto log = kRoot / "benchmarks/out/planner_arena" / (file + "-" + result.planner + ".log");
  const std::vector<PlannerRun> all = RunPlanner(
      setup, planner, kBudget_s, runs, log, scenario.name,
      [&](const og::PathGeometric& path) { result.touching += Touches(truth, scenario, path); });
  std::vector<double> first_s, arrival_s;
  for (const PlannerRun& run : all) {
    first_s.push_back(run.solved ? run.first_s : kBudget_s);
    if (run.solved) arrival_s.push_back(run.arrival_s);
  }
  result.solved_fraction = static_cast<double>(arrival_s.size()) / static_cast<double>(all.size());
  result.first_s = MedianOf(first_s);
  result.arrival_s = MedianOf(arrival_s);
  std::printf("%-16s %-13s %4zu of %3zu  %8.2f ms [%.2f, %.2f]  %7.2f s [%.2f, %.2f]  touch: %d\n",
              file.c_str(), result.planner.c_str(), arrival_s.size(), all.size(),
              1e3 * result.first_s.median, 1e3 * result.first_s.low, 1e3 * result.first_s.high,
              result.arrival_s.median, result.arrival_s.low, result.arrival_s.high,
              result.touching);
  std::fflush(stdout);
  return result;
}

// What the summary says of all scenarios together: the worst.
struct Worst {
  double solved_fraction = 1;
  double over_optimum_x = 0, vs_rrtconnect_x = std::numeric_limits<double>::infinity();
  int touching = 0;
};

void RunSolvable(benchmark::State& state, const cli::Scenario& scenario, const std::string& file,
                 const RunCounts& counts, Worst& worst) {
  if (!IsNotVoid(scenario)) return state.SkipWithError((file + " is void").c_str());
  const World truth = TruthOf(scenario);
  const og::SimpleSetupPtr setup = SetupOf(scenario, Sees::kAll);
  const auto& si = setup->getSpaceInformation();
  const Result ours =
      Run(scenario, file, truth, *setup, std::make_shared<SafeIntervalPlanner>(si), counts.ours);
  Run(scenario, file, truth, *setup, std::make_shared<og::RRT>(si), counts.others);
  const Result connect =
      Run(scenario, file, truth, *setup, std::make_shared<og::RRTConnect>(si), counts.others);
  Run(scenario, file, truth, *setup, std::make_shared<og::RRTstar>(si), counts.others);
  worst.solved_fraction = std::min(worst.solved_fraction, ours.solved_fraction);
  worst.touching += ours.touching;
  worst.vs_rrtconnect_x =
      std::min(worst.vs_rrtconnect_x, connect.first_s.median / ours.first_s.median);
  if (scenario.optimum_s) {
    worst.over_optimum_x =
        std::max(worst.over_optimum_x, ours.arrival_s.median / *scenario.optimum_s);
  }
  state.counters["plan_" + file + "_first_ms"] = 1e3 * ours.first_s.median;
  state.counters["plan_" + file + "_first_low_ms"] = 1e3 * ours.first_s.low;
  state.counters["plan_" + file + "_first_high_ms"] = 1e3 * ours.first_s.high;
  state.counters["plan_" + file + "_arrival_s"] = ours.arrival_s.median;
  state.counters["plan_" + file + "_arrival_low_s"] = ours.arrival_s.low;
  state.counters["plan_" + file + "_arrival_high_s"] = ours.arrival_s.high;
}

// There must be no plan, and an end in time.
void RunUnsolvable(benchmark::State& state, const cli::Scenario& scenario,
                   const std::string& file) {
  const auto begin = std::chrono::steady_clock::now();
  int plans = 0;
  const auto outcome = Solve(
      scenario.task, CheckerOf(scenario, Sees::kAll), FromSeconds(kBudget_s),
      [&](const Plan&) { ++plans; }, [] { return false; });
  const double took_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const bool none = outcome.ok() && outcome->status != PlanStatus::kFound && plans == 0;
  if (!none) return state.SkipWithError((file + " has a plan, or failed").c_str());
  if (took_s > 2 * kBudget_s) return state.SkipWithError((file + " took too long").c_str());
  const bool goal = outcome->status == PlanStatus::kGoalBlocked;
  std::printf("%-16s no plan after %.2f s: %s\n", file.c_str(), took_s,
              goal ? "the goal is taken" : "none was found");
}

// One scenario; the counters of all together are of those that ran before it, too.
void RunScenario(benchmark::State& state, const cli::Scenario& scenario, const std::string& file,
                 const RunCounts& counts, Worst& worst) {
  for (auto _ : state) {
    if (scenario.solvable) {
      RunSolvable(state, scenario, file, counts, worst);
    } else {
      RunUnsolvable(state, scenario, file);
    }
  }
  state.counters["plan_success_fraction"] = worst.solved_fraction;
  state.counters["plan_touching"] = worst.touching;
  if (std::isfinite(worst.vs_rrtconnect_x)) {
    state.counters["plan_vs_rrtconnect_x"] = worst.vs_rrtconnect_x;
  }
  state.counters["plan_over_optimum_x"] = worst.over_optimum_x;
}

void Register(const Effort& effort) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(1);
  if (const auto data = DataPath("")) setenv("CLEARWAY_DATA", data->c_str(), 0);  // scenarios' own
  const RunCounts counts = effort.quick ? RunCounts{5, 2} : RunCounts{100, 20};
  Effort once = effort;
  once.repetitions = 1;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot / "examples/scenarios")) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  const auto worst = std::make_shared<Worst>();
  for (const auto& path : files) {
    const std::string file = path.stem().string();
    const auto scenario = cli::LoadScenario(path);
    if (absl::IsNotFound(scenario.status())) {  // of a recording
      std::printf("%s\n", scenario.status().ToString().c_str());
      continue;
    }
    Add("scenarios/" + file, once, [=](auto& state) {
      if (!scenario.ok()) return state.SkipWithError(scenario.status().ToString().c_str());
      RunScenario(state, *scenario, file, counts, *worst);
    });
  }
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
