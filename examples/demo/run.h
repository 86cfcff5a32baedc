// The demo from end to end.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "demo/plan.h"

namespace clearway::demo {

// A plain value.
struct DemoOptions {
  std::string data;                                    // a LiDAR folder; empty: the simulator
  std::vector<std::size_t> plan_after = {20, 40, 60};  // frames of the folder, ascending
  std::string scenario = "crossing";                   // of the simulator
  std::filesystem::path output = "demo-output";
  std::string server;  // the program
  // Drive the crossings while frames keep coming, instead of planning each once.
  bool drive = false;
  PlanSettings planning;
};

// Starts a server, replays, asks, plans, judges, and writes pictures and summary.json. Whether
// every case passed.
absl::StatusOr<bool> RunDemo(const DemoOptions& options, std::ostream& out, bool is_terminal);

}  // namespace clearway::demo
