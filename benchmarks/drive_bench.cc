// A recorded drive with a robot in it: from twenty start frames on the demo drives crossings before
// the van and the cyclist while the recording's scans come, replanning on each version that breaks
// its way, and is judged by the recorded boxes. What is counted does not depend on the machine's
// speed, and it runs once.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "demo/run.h"
#include "summary.h"
#include "support/data_folder.h"

namespace clearway::bench {
namespace {

using Json = nlohmann::json;

// What came of the crossings in a summary of the demo.
void Count(const Json& summary, benchmark::State& state) {
  double drives = 0, arrived = 0, touching = 0;
  std::set<std::int64_t> starts;
  for (const Json& drive : summary.at("drives")) {
    ++drives;
    starts.insert(drive.at("crossing").at("stamp_ns").get<std::int64_t>());
    touching += drive.at("verdict").at("contact").get<bool>();
    arrived += drive.at("passed").get<bool>();
  }
  double void_cases = 0;
  for (const Json& stop : summary.at("stops")) void_cases += stop.at("cases").size();
  state.counters["drive_start_frames"] = static_cast<double>(starts.size());
  state.counters["drive_crossings"] = drives;
  state.counters["drive_void"] = void_cases;
  state.counters["drive_touching"] = touching;
  state.counters["drive_arrived_fraction"] = drives > 0 ? arrived / drives : 0;
}

void Drive(benchmark::State& state, const std::string& folder, const Effort& effort) {
  demo::DemoOptions options;
  options.data = folder;
  options.drive = true;
  options.server = CLEARWAY_SERVER_BINARY;
  options.output = std::filesystem::path(CLEARWAY_SOURCE_DIR) / "benchmarks/out/drives";
  options.plan_after.clear();
  const std::size_t starts = effort.quick ? 2 : 20;
  for (std::size_t i = 0; i < starts; ++i) options.plan_after.push_back(4 + 2 * i);
  for (auto _ : state) {
    std::ostringstream told;
    const auto passed = demo::RunDemo(options, told, false);
    if (!passed.ok()) return state.SkipWithError(passed.status().ToString().c_str());
    std::ifstream summary(options.output / "summary.json");
    Count(Json::parse(summary), state);
  }
}

void Register(const Effort& effort) {
  const auto folder = DataPath("kitti0000_fov");
  if (!folder) return;  // it has said so
  Add("drive", {effort.quick, 1}, [=](auto& state) { Drive(state, folder->string(), effort); });
}

}  // namespace
}  // namespace clearway::bench

int main(int argc, char** argv) {
  return clearway::bench::Main(argc, argv, clearway::bench::Register, {});
}
