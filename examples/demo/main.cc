// The main job end to end: labelled scans in, a plan around moving objects out.
#include <ompl/util/RandomNumbers.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "demo/run.h"

int main(int argc, char** argv) {
  clearway::demo::DemoOptions options;
  std::uint32_t seed = 1;
  CLI::App app(
      "Starts a server, replays a sequence through it, asks what is where and when, plans "
      "crossings before moving objects, and judges the plans by what really happened.\n"
      "Example: clearway-demo --server build/release/server/clearway-server --out demo-output");
  app.option_defaults()->always_capture_default();
  auto* const data =
      app.add_option("--data", options.data, "Folder of LiDAR scans; without it, the simulator")
          ->check(CLI::ExistingDirectory);
  app.add_option("--plan-after", options.plan_after, "Frames of the folder after which to plan")
      ->delimiter(',');
  app.add_flag("--drive", options.drive,
               "Drive the crossings while frames keep coming, deciding again when the way is no "
               "longer free and twice a second, instead of planning each once")
      ->needs(data);
  app.add_option("--scenario", options.scenario, "World of the simulator");
  app.add_option("--out", options.output, "Folder for summary.json and the pictures");
  app.add_option("--server", options.server, "The server's program")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--margin", options.planning.margins_m,
                 "Metres to keep clear of everything; the first for which there is a place")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 2.0));
  app.add_option("--inflation", options.planning.inflations_mps,
                 "Metres a second by which predictions grow; the first that leaves a way. With "
                 "--drive the first for the next 2 s, the last for what is later")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 2.0));
  app.add_option("--iterations", options.planning.iterations,
                 "How many ways the planner follows, at most, with each inflation")
      ->check(CLI::Range(1u, 10'000'000u));
  app.add_option("--seed", seed, "Of the planner's random numbers")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  std::ranges::sort(options.plan_after);
  ompl::RNG::setSeed(seed);

  const auto passed = clearway::demo::RunDemo(options, std::cout, isatty(STDOUT_FILENO) != 0);
  if (!passed.ok()) {
    std::cerr << "clearway-demo: " << passed.status().ToString() << "\n";
    return 2;
  }
  std::cout << (*passed ? "Every plan passed.\n" : "Not every plan passed.\n");
  return *passed ? 0 : 1;
}
