// clearway load-prior: a known static map for the server.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "absl/strings/str_cat.h"
#include "clearway/client/scene_client.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/message.h"
#include "cli/server_flags.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] = "  clearway load-prior building.bt";

struct Flags {
  ServerFlags server;
  std::string file;
  bool json = false;
};

absl::StatusOr<std::string> ReadWhole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return absl::NotFoundError(absl::StrCat(path, ": cannot be opened"));
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (file.bad()) return absl::DataLossError(absl::StrCat(path, ": cannot be read"));
  return bytes;
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const std::string extension = std::filesystem::path(flags.file).extension().string();
  if (extension != ".bt" && extension != ".ot") {
    return UsageError(
        absl::StrCat("file: expected an OctoMap file, .bt or .ot, not '", flags.file, "'"));
  }
  const auto bytes = ReadWhole(flags.file);
  if (!bytes.ok()) return bytes.status();
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const auto scene = SceneClient(*connection)
                         .LoadPrior(extension == ".bt" ? MapFormat::kBt : MapFormat::kOt, *bytes);
  if (!scene.ok()) return InContext(flags.file, scene.status());
  if (flags.json) {
    Print(terminal.out, ToJson(*scene));
  } else {
    terminal.out << "loaded " << flags.file << " (" << Bytes(bytes->size())
                 << ") into scene version " << scene->version << "\n";
  }
  return absl::OkStatus();
}

}  // namespace

void AddLoadPrior(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "load-prior", "Send a known static map to the server",
                                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command->add_option("file", flags->file, "OctoMap file (.bt, .ot) of the scene's resolution")
      ->required();
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
