// clearway clear-region: makes a part of the static map unknown again.
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/base/number_text.h"
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

void NoteIfBetweenCenters(const ClearedRegion& cleared, const Aabb& box_W, double resolution_m,
                          std::ostream& err) {
  // Larger boxes hold none where the grid ends; the note about the map's span says so.
  if (cleared.voxels_in_box > 0 || (box_W.max - box_W.min).minCoeff() >= resolution_m) return;
  err << "note: the box holds no centre of a voxel, so nothing is cleared; voxels of "
      << NumberText(resolution_m) << " m have centres at odd multiples of "
      << NumberText(resolution_m / 2) << " m\n";
}

std::string AsText(const ClearedRegion& cleared, const Aabb& box_W) {
  const std::string box = absl::StrCat("from ", Point(box_W.min), " to ", Point(box_W.max), " m");
  const std::string version = absl::StrCat(" in scene version ", cleared.version, "\n");
  if (cleared.voxels_in_box == 0) return absl::StrCat("no voxel cleared ", box, version);
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();  // or more
  const bool is_countable = cleared.voxels_in_box < kMost;
  return absl::StrCat("the static map is unknown ", box, version, Grouped(cleared.voxels_cleared),
                      is_countable ? absl::StrCat(" of ", Grouped(cleared.voxels_in_box)) : "",
                      " voxels cleared; the others were unknown before\n");
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);
  if (auto status = NoteIfOutside(client, flags.box_W, terminal.err); !status.ok()) return status;
  const auto cleared = client.ClearRegion(flags.box_W);
  if (!cleared.ok()) return cleared.status();
  NoteIfBetweenCenters(*cleared, flags.box_W, (*connection)->server().params.resolution_m,
                       terminal.err);
  if (flags.json) {
    Json json = ToJson(*cleared);
    json["box_world"] = ToJson(flags.box_W);
    json["voxels_cleared"] = cleared->voxels_cleared;
    json["voxels_in_box"] = cleared->voxels_in_box;
    Print(terminal.out, json);
  } else {
    terminal.out << AsText(*cleared, flags.box_W);
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
