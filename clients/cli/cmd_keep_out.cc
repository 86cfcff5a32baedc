// clearway keep-out: boxes that count as occupied whatever is seen there.
#include <memory>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clearway/client/scene_client.h"
#include "clearway/report/table.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/server_flags.h"
#include "cli/text.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway keep-out                                  lists the boxes\n"
    "  clearway keep-out --add 2,-1,0,4,1,2.5             adds one\n"
    "  clearway keep-out --clear --add -5,-5,-1,5,5,3     replaces them all\n"
    "  clearway keep-out --clear";

struct Flags {
  ServerFlags server;
  std::vector<Aabb> add;
  bool clear = false;
  bool json = false;
};

struct KeepOut {
  Versioned scene;
  std::vector<Aabb> boxes_W;
};

absl::StatusOr<KeepOut> Listed(const SceneClient& client) {
  const auto info = client.GetServerInfo();
  if (!info.ok()) return info.status();
  return KeepOut{*info, info->params.keep_out_W};
}

// The server replaces all boxes at once, so adding reads them first: of two clients that add at the
// same moment one may win.
absl::StatusOr<KeepOut> Changed(const SceneClient& client, const Flags& flags) {
  KeepOut boxes;
  if (!flags.clear) {
    auto listed = Listed(client);
    if (!listed.ok()) return listed.status();
    boxes = *std::move(listed);
  }
  boxes.boxes_W.insert(boxes.boxes_W.end(), flags.add.begin(), flags.add.end());
  const auto scene = client.SetKeepOut(boxes.boxes_W);
  if (!scene.ok()) return scene.status();
  boxes.scene = *scene;
  return boxes;
}

Json AsJson(const KeepOut& keep_out) {
  Json json = ToJson(keep_out.scene);
  json["boxes_world"] = Json::array();
  for (const Aabb& box : keep_out.boxes_W) json["boxes_world"].push_back(ToJson(box));
  return json;
}

void PrintText(std::ostream& out, const KeepOut& keep_out) {
  out << "keep-out boxes of scene version " << keep_out.scene.version << ": "
      << keep_out.boxes_W.size() << "\n";
  if (keep_out.boxes_W.empty()) return;
  Table table({"lowest corner m", "highest corner m", "size"});
  for (const Aabb& box : keep_out.boxes_W) {
    table.AddRow({Point(box.min), Point(box.max), Size(box.Size())});
  }
  out << table.ToString();
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);
  const bool changes = flags.clear || !flags.add.empty();
  const auto keep_out = changes ? Changed(client, flags) : Listed(client);
  if (!keep_out.ok()) return keep_out.status();
  if (flags.json) {
    Print(terminal.out, AsJson(*keep_out));
  } else {
    PrintText(terminal.out, *keep_out);
  }
  return absl::OkStatus();
}

}  // namespace

void AddKeepOut(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      AddCommand(cli, "keep-out", "List, add or remove boxes that always count as occupied",
                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  AddParsedList(command, "--add", &flags->add, ParseSolidBox,
                "Add x0,y0,z0,x1,y1,z1: the lowest and the highest corner\nin the world frame, in "
                "metres. May be given several times")
      ->type_name("BOX");
  command->add_flag("--clear", flags->clear,
                    "Remove all boxes, those of the server's configuration\ntoo; with --add, "
                    "replace them");
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
