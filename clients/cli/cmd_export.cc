// clearway export: a map of the server as a file.
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/io/file_type.h"
#include "clearway/io/ply.h"
#include "cli/commands.h"
#include "cli/export_target.h"
#include "cli/json.h"
#include "cli/message.h"
#include "cli/server_flags.h"
#include "cli/source_flags.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway export --what static --out map.bt\n"
    "  clearway export --what object:1 --out van.ply\n"
    "  clearway export --out map_in_utm.ply --origin 500000,4100000,0\n"
    "  clearway export --what scene@+1.0 --format ot --out - > future.ot";

struct Flags {
  ServerFlags server;
  ExportArgument what;
  std::optional<MapFormat> format;
  std::string out;
  std::optional<Eigen::Vector3d> origin_m;
  bool json = false;
};

// The format that was asked for, or that the file's extension names.
absl::StatusOr<MapFormat> FormatOf(const Flags& flags) {
  if (flags.format) return *flags.format;
  const std::string extension = LowerExtension(flags.out);
  auto format = ParseMapFormat(extension.empty() ? "" : extension.substr(1));
  if (!format.ok()) {
    return UsageError("give --format, or an --out that ends in .bt, .ot or .ply");
  }
  return format;
}

absl::Status CheckOrigin(const Flags& flags, MapFormat format) {
  if (!flags.origin_m) return absl::OkStatus();
  if (format != MapFormat::kPly) {
    return UsageError("--origin: OctoMap files cannot hold far coordinates; export a PLY");
  }
  if (std::holds_alternative<ObjectTarget>(flags.what)) {
    return UsageError("--origin: an object's map is in the object's own frame");
  }
  return absl::OkStatus();
}

absl::StatusOr<ExportTarget> TargetOf(const ExportArgument& what, const SceneClient& client) {
  if (const auto* object = std::get_if<ObjectTarget>(&what)) return *object;
  const auto* scene = std::get_if<SceneAtArgument>(&what);
  if (scene == nullptr) return StaticMapTarget{};
  const auto status = client.GetStatus();
  if (!status.ok()) return status.status();
  return SceneAtTarget{scene->time.At(status->stamp)};
}

struct Exported : Versioned {
  std::uint64_t bytes = 0;
};

absl::Status Put(std::string_view bytes, std::ostream& stream, Exported& exported) {
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  exported.bytes += bytes.size();
  return stream ? absl::OkStatus()
                : absl::UnavailableError(absl::StrCat("cannot be written: ", std::strerror(errno)));
}

absl::StatusOr<Exported> WriteTo(std::ostream& stream, const SceneClient& client,
                                 const ExportTarget& target, MapFormat format,
                                 const std::optional<Eigen::Vector3d>& origin_m) {
  Exported exported;
  std::string kept;  // the whole file, if it is still to be moved
  const auto answer = client.ExportMap(target, format, [&](std::string_view piece) {
    if (!origin_m) return Put(piece, stream, exported);
    kept += piece;
    return absl::OkStatus();
  });
  if (!answer.ok()) return answer.status();
  static_cast<Versioned&>(exported) = *answer;
  if (!origin_m) return exported;
  const auto moved = WithOriginAdded(kept, *origin_m);
  if (!moved.ok()) return moved.status();
  if (auto status = Put(*moved, stream, exported); !status.ok()) return status;
  return exported;
}

// The file appears under its name only when it is whole.
absl::StatusOr<Exported> WriteFile(const std::string& path, const SceneClient& client,
                                   const ExportTarget& target, MapFormat format,
                                   const std::optional<Eigen::Vector3d>& origin_m) {
  const auto whole = OutputFile(path);
  if (!whole.ok()) return whole.status();
  const std::string partial = whole->string() + ".partial";
  std::ofstream file(partial, std::ios::binary | std::ios::trunc);
  if (!file) {
    return absl::UnavailableError(
        absl::StrCat(path, ": cannot be written: ", std::strerror(errno)));
  }
  auto exported = WriteTo(file, client, target, format, origin_m);
  file.close();
  if (exported.ok() && file) {
    const absl::Status moved = MoveInto(partial, *whole);
    return moved.ok() ? exported : moved;
  }
  std::error_code ignored;
  std::filesystem::remove(partial, ignored);
  if (!exported.ok()) return exported.status();
  return absl::UnavailableError(absl::StrCat(path, ": cannot be written"));
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto format = FormatOf(flags);
  if (!format.ok()) return format.status();
  if (auto status = CheckOrigin(flags, *format); !status.ok()) return status;
  const bool to_stdout = flags.out == "-";
  if (to_stdout && flags.json) return UsageError("--json and --out - both want stdout");
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const SceneClient client(*connection);
  const auto target = TargetOf(flags.what, client);
  if (!target.ok()) return target.status();
  const auto exported = to_stdout ? WriteTo(terminal.out, client, *target, *format, flags.origin_m)
                                  : WriteFile(flags.out, client, *target, *format, flags.origin_m);
  if (!exported.ok()) return exported.status();
  if (to_stdout) return absl::OkStatus();
  if (flags.json) {
    Json json = ToJson(static_cast<const Versioned&>(*exported));
    json.update(Json{{"file", flags.out}, {"bytes", exported->bytes}});
    if (flags.origin_m) json["origin_m"] = ToJson(*flags.origin_m);
    Print(terminal.out, json);
  } else {
    terminal.out << "wrote " << flags.out << ": " << Bytes(exported->bytes) << ", scene version "
                 << exported->version << "\n";
  }
  return absl::OkStatus();
}

}  // namespace

void AddExport(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "export", "Save a map of the server as a file", kExamples,
                                 [flags, &cli] { return Run(*flags, cli.terminal); });
  AddParsed(
      command, "--what", &flags->what, ParseExportTarget,
      "static (default), object:ID in its own frame, or\nscene@TIME: everything as it is then "
      "(scene: now)")
      ->type_name("MAP");
  AddParsed(command, "--origin", &flags->origin_m, ParseOriginPoint,
            "Add x,y,z to every point of a PLY, in double precision:\nwhat --origin of 'replay' "
            "subtracted (its note says it)")
      ->type_name("ORIGIN");
  AddParsed(
      command, "--format", &flags->format, ParseMapFormat,
      "bt (OctoMap, three-way), ot (OctoMap, log-odds), ply\n(occupied voxels); default: by the "
      "file's name")
      ->type_name("FORMAT");
  command->add_option("-o,--out", flags->out, "The file to write; - is stdout")
      ->required()
      ->type_name("FILE");
  command->add_flag("--json", flags->json, "Print a summary as JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
