// clearway occupancy: what is where, now or at another time.
#include <memory>

#include "absl/strings/str_cat.h"
#include "cli/commands.h"
#include "cli/message.h"
#include "cli/occupancy_answers.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway occupancy --at 12.5,-3,0.5 --time +1.5\n"
    "  clearway occupancy --box 0,-10,0,20,10,2 --time now --time +1 --time +2\n"
    "  clearway occupancy --slice 0.5 --area 0,-20,60,20 --time +1.5";

absl::Status CheckTogether(const OccupancyFlags& flags) {
  const int kinds =
      (flags.points.empty() ? 0 : 1) + (flags.box ? 1 : 0) + (flags.slice_z_m ? 1 : 0);
  if (kinds != 1) return UsageError("give one of --at, --box and --slice");
  if (!flags.slice_z_m && (flags.area || flags.cell_m)) {
    return UsageError("--area and --cell belong to --slice");
  }
  return absl::OkStatus();
}

absl::Status Run(const OccupancyFlags& flags, const Terminal& terminal) {
  if (const absl::Status status = CheckTogether(flags); !status.ok()) return status;
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);
  const auto scene = client.GetStatus();
  if (!scene.ok()) return scene.status();
  std::vector<Time> times;
  for (const TimeArgument& time : flags.times) times.push_back(time.At(scene->stamp));
  if (times.empty()) times.push_back(scene->stamp);

  if (!flags.points.empty()) return AnswerPoints(flags, client, times, terminal);
  if (flags.box) return AnswerBox(flags, client, times, terminal);
  return AnswerSlice(flags, client, *scene, times, **connection, terminal);
}

}  // namespace

void AddOccupancy(Cli& cli) {
  auto flags = std::make_shared<OccupancyFlags>();
  CLI::App* command = AddCommand(cli, "occupancy", "Ask what is where, now or later", kExamples,
                                 [flags, &cli] { return Run(*flags, cli.terminal); });
  AddParsedList(command, "--at", &flags->points, ParsePoint, "A point in metres (may be repeated)")
      ->type_name("X,Y,Z");
  AddParsed(command, "--box", &flags->box, ParseBox,
            "Count the cells of a box, given by two corners")
      ->type_name("X,Y,Z,X,Y,Z");
  AddParsed(command, "--slice", &flags->slice_z_m, ParseFinite,
            "Draw the horizontal slice at this height")
      ->type_name("Z");
  AddParsed(command, "--area", &flags->area, ParseArea,
            "Of the slice, by two corners (default: all that is\nknown within 50 m of its middle)")
      ->type_name("X,Y,X,Y");
  command
      ->add_option("--cell", flags->cell_m, "Of the slice: cell size in metres\n(default: a voxel)")
      ->check(Between(0.001, 1e5));
  AddParsedList(command, "--time", &flags->times, ParseTime,
                "+seconds after the newest stamp, or seconds of\nsensor time (default: now; may be "
                "repeated)")
      ->type_name("TIME");
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
