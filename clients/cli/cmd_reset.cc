// clearway reset: the empty scene again.
#include <memory>

#include "clearway/client/scene_client.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/server_flags.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] = "  clearway reset && clearway replay drive.cwr";

struct Flags {
  ServerFlags server;
  bool json = false;
};

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const auto scene = SceneClient(*connection).Reset();
  if (!scene.ok()) return scene.status();
  if (flags.json) {
    Print(terminal.out, ToJson(*scene));
  } else {
    terminal.out << "the scene is empty again (version " << scene->version << ")\n";
  }
  return absl::OkStatus();
}

}  // namespace

void AddReset(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command =
      AddCommand(cli, "reset", "Forget the whole scene: static map, objects, answered frames",
                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
