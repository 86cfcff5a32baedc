// Text files that people write. The first line says which: "scenario", "robot", "objects",
// "states", "people" (UCY), "tokens", "config" (TOML) or "commonroad" (XML).
#include <cstdlib>

#include "clearway/io/ucy_people.h"
#include "clearway/wire/token_table.h"
#include "cli/robot_file.h"
#include "cli/scenario_file.h"
#include "cli/state_list.h"
#include "fuzz/fuzz.h"
#include "server/config.h"
#include "support/temporary_folder.h"

namespace clearway::fuzz {
namespace {

void RunConfig(const std::string& path) {
  const auto line = ReadCommandLine({"--config", path}, {});
  RequireForeseen(line.status());
  if (!line.ok() || !line->help.empty()) return;
  const TemporaryFolder folder;
  const auto again =
      ReadCommandLine({"--config", folder.Write("again.toml", ToToml(line->config)).string()}, {});
  Require(again.ok(), "its own TOML is refused: " + again.status().ToString());
  Require(ToToml(again->config) == ToToml(line->config), "its own TOML says something else");
}

// A CommonRoad file is read where a scenario names it.
void RunCommonRoad(const TemporaryFolder& folder, std::string_view xml) {
  folder.Write("road.xml", xml);
  const std::string scenario = R"({"name": "road", "robot": {"name": "disc", "links": [
    {"name": "body", "shapes": [{"type": "cylinder", "radius_m": 0.3, "length_m": 1}]}]},
    "space": {"kind": "r2", "min_m": [-50, -50], "max_m": [50, 50], "max_speed_mps": 2},
    "start": [0, 0], "goal": [9, 0],
    "tracks": {"format": "commonroad", "file": "road.xml", "for_s": 10}})";
  RequireForeseen(cli::ParseScenario(folder / "scenario.json", scenario).status());
}

void RunFile(std::string_view kind, const TemporaryFolder& folder, std::string_view text) {
  const std::string path = folder.Write("file", text).string();
  LeftOut left_out;
  if (kind == "config") RunConfig(path);
  if (kind == "people") RequireForeseen(ReadUcyPeople(path, left_out).status());
  if (kind == "objects") RequireForeseen(cli::LoadObjects(path).status());
  if (kind == "commonroad") RunCommonRoad(folder, text);
}

void Run(std::string_view input) {
  static const TemporaryFolder folder;
  [[maybe_unused]] static const int data = setenv("CLEARWAY_DATA", folder.path().c_str(), 1);
  const std::string_view kind = TakeLine(input);
  const std::string text(input);
  if (kind == "scenario") {
    RequireForeseen(cli::ParseScenario(folder / "scenario.json", text).status());
  } else if (kind == "robot") {
    RequireForeseen(cli::ParseRobot(folder / "robot.json", text).status());
  } else if (kind == "states") {
    RequireForeseen(cli::ReadStates("states.csv", text).status());
  } else if (kind == "tokens") {
    RequireForeseen(TokenTable::Parse("tokens", text).status());
  } else {
    RunFile(kind, folder, text);
  }
}

}  // namespace
}  // namespace clearway::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clearway::fuzz::Run(clearway::fuzz::TextOf(data, size));
  return 0;
}
