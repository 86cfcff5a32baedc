#include "summary.h"

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

namespace clearway::bench {
namespace {

// Prints as usual and keeps the medians.
class MedianReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      failed |= run.error_occurred;
      const bool median = run.run_type == Run::RT_Aggregate && run.aggregate_name == "median";
      const bool only_one = run.run_type == Run::RT_Iteration && run.repetitions == 1;
      if (!median && !only_one) continue;
      medians[run.run_name.function_name] =
          run.GetAdjustedRealTime() * 1e3 / benchmark::GetTimeUnitMultiplier(run.time_unit);
      for (const auto& [name, counter] : run.counters) {
        if (name != "items_per_second") counters[name] = counter.value;  // the library's own
      }
    }
  }

  // The median of a benchmark's time, or of a counter.
  std::optional<double> Find(const std::string& name) const {
    if (const auto time = medians.find(name); time != medians.end()) return time->second;
    if (const auto counter = counters.find(name); counter != counters.end()) return counter->second;
    return std::nullopt;
  }

  std::map<std::string, double> medians;  // of times, in ms, by the benchmarks' names
  std::map<std::string, double> counters;
  bool failed = false;
};

struct Flags {
  Effort effort;
  std::filesystem::path out = std::filesystem::path(CLEARWAY_SOURCE_DIR) / "benchmarks" / "out";
};

void PrintHelp() {
  std::puts(
      "--quick    fewer scans and repetitions\n"
      "--out DIR  where summary.json is written (benchmarks/out in the source tree)\n"
      "Google Benchmark's own flags:");
  benchmark::PrintDefaultHelp();
}

// Takes our flags out of the arguments.
Flags TakeFlags(int& argc, char** argv) {
  Flags flags;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) {
      flags.effort = {true, 3};
    } else if (std::strcmp(argv[i], "--out") == 0 && i + 1 < argc) {
      flags.out = argv[++i];
    } else {
      argv[kept++] = argv[i];
    }
  }
  argc = kept;
  return flags;
}

void AddToSummary(const std::filesystem::path& folder, const nlohmann::json& numbers) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / "summary.json";
  nlohmann::json summary = nlohmann::json::object();
  if (std::ifstream before(file); before) summary = nlohmann::json::parse(before, nullptr, false);
  if (!summary.is_object()) summary = nlohmann::json::object();
  summary.update(numbers);
  std::ofstream(file) << summary.dump(2) << "\n";
}

}  // namespace

void Add(const std::string& name, const Effort& effort,
         const std::function<void(benchmark::State&)>& run, int iterations) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(iterations)
      ->Repetitions(effort.repetitions)
      ->UseRealTime()
      ->ReportAggregatesOnly();
}

int Main(int argc, char** argv, const std::function<void(const Effort&)>& register_all,
         const std::vector<Ratio>& ratios, Order order) {
  const Flags flags = TakeFlags(argc, argv);
  std::vector<char*> arguments(argv, argv + argc);
  std::string in_turns = "--benchmark_enable_random_interleaving=true";
  if (order == Order::kInTurns) arguments.insert(arguments.begin() + 1, in_turns.data());
  argc = static_cast<int>(arguments.size());
  argv = arguments.data();
  benchmark::Initialize(&argc, argv, PrintHelp);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  register_all(flags.effort);
  MedianReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  nlohmann::json numbers = nlohmann::json::object();
  for (const Ratio& ratio : ratios) {
    const auto over = reporter.Find(ratio.over), under = reporter.Find(ratio.under);
    if (!over || !under) continue;
    numbers[ratio.name] = *over / *under;
    std::printf("%-40s %10.2f\n", ratio.name.c_str(), *over / *under);
  }
  for (const auto& [name, value] : reporter.counters) {
    numbers[name] = value;
    std::printf("%-40s %10.3f\n", name.c_str(), value);
  }
  AddToSummary(flags.out, numbers);
  return reporter.failed ? 1 : 0;
}

}  // namespace clearway::bench
