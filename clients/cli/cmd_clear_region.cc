// clearway clear-region: makes a part of the static map unknown again.
#include <memory>

#include "clearway/client/scene_client.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/server_flags.h"
#include "cli/text.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway clear-region 2,-1,0,4,1,2.5       from its lowest to its highest corner\n"
    "  clearway clear-region -5,-5,-1,5,5,3 --json";

struct Flags {
  ServerFlags server;
  Aabb box_W;
  bool json = false;
};

// Clearing nothing is not an error, but hardly what was wanted.
absl::Status NoteIfOutside(const SceneClient& client, const Aabb& box_W, std::ostream& err) {
  const auto status = client.GetStatus();
  if (!status.ok()) return status.status();
  const Aabb& known_W = status->static_box_W;
  if (known_W.Empty()) {
    err << "note: the static map is empty; there is nothing to clear\n";
  } else if (!box_W.Intersects(known_W)) {
    err << "note: the static map has no observed voxel in the box; it spans " << Point(known_W.min)
        << " to " << Point(known_W.max) << " m\n";
  }
  return absl::OkStatus();
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);
  if (auto status = NoteIfOutside(client, flags.box_W, terminal.err); !status.ok()) return status;
  const auto scene = client.ClearRegion(flags.box_W);
  if (!scene.ok()) return scene.status();
  if (flags.json) {
    Json json = ToJson(*scene);
    json["box_world"] = ToJson(flags.box_W);
    Print(terminal.out, json);
  } else {
    terminal.out << "the static map is unknown from " << Point(flags.box_W.min) << " to "
                 << Point(flags.box_W.max) << " m in scene version " << scene->version << "\n";
  }
  return absl::OkStatus();
}

}  // namespace

void AddClearRegion(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "clear-region", "Make a box of the static map unknown again",
                                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  AddParsed(command, "box", &flags->box_W, ParseOrderedBox,
            "x0,y0,z0,x1,y1,z1: the lowest and the highest corner in\nthe world frame, in metres. "
            "Voxels whose centre lies in it\nbecome unknown; later frames map them anew")
      ->required()
      ->type_name("BOX");
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
