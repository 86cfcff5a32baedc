// clearway load-prior: a known static map for the server.
#include <memory>
#include <optional>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/base/file.h"
#include "clearway/base/number_text.h"
#include "clearway/client/scene_client.h"
#include "clearway/io/file_type.h"
#include "clearway/io/octomap_file.h"
#include "clearway/map/resolution.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/message.h"
#include "cli/open_source.h"
#include "cli/server_flags.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway load-prior building.bt\n"
    "  clearway load-prior building_5cm.bt --resample";
constexpr std::uint64_t kMaxBytes = OctomapLimits().max_bytes;

struct Flags {
  ServerFlags server;
  std::string file;
  bool resample = false;
  bool json = false;
};

// A map as it is sent.
struct Prior {
  MapFormat format = MapFormat::kBt;
  std::string bytes;
  std::optional<double> resampled_from_m;
};

absl::StatusOr<Prior> ReadPrior(const std::string& file) {
  auto bytes = ReadWholeFile(file, kMaxBytes);
  if (absl::IsNotFound(bytes.status()) && !HasMapExtension(file)) {
    return UsageError(absl::StrCat("file: expected an OctoMap file, .bt or .ot, not '", file, "'"));
  }
  if (!bytes.ok()) return bytes.status();
  const FileKind kind = KindOfBytes(*bytes);
  if (kind.type == FileType::kOctomapBt) return Prior{MapFormat::kBt, *std::move(bytes), {}};
  if (kind.type == FileType::kOctomapOt) return Prior{MapFormat::kOt, *std::move(bytes), {}};
  const std::string name = KindOfFile(file).name;
  return absl::InvalidArgumentError(
      absl::StrCat(file, ": not an OctoMap file", name.empty() ? "" : "; the file is ", name));
}

// The prior in voxels of the server's size, if its own have another.
absl::Status ResampleTo(double resolution_m, const std::string& file, Prior& prior) {
  const auto read = ParseOctomap(file, prior.bytes);
  if (!read.ok()) return read.status();
  const double from_m = read->map.grid().resolution_m();
  if (SameResolution(from_m, resolution_m)) return absl::OkStatus();
  const auto map = Resample(read->map, resolution_m);
  if (absl::IsResourceExhausted(map.status())) {
    return absl::ResourceExhaustedError(absl::StrCat(
        file, ": ", map.status().message(),
        ". Start the server with larger voxels (clearway-server --scene-resolution-m); the map's "
        "have ",
        NumberText(from_m), " m"));
  }
  if (!map.ok()) return InContext(file, map.status());
  auto bytes = SerializeOctomap(*map, OctomapFormat::kBinary);
  if (!bytes.ok()) return InContext(file, bytes.status());
  prior = {MapFormat::kBt, *std::move(bytes), from_m};
  return absl::OkStatus();
}

// What helps if the server refused a map because of its voxels' size.
absl::Status WithAdvice(const absl::Status& refused, const std::string& file, const Prior& prior,
                        double resolution_m) {
  const absl::Status status = InContext(file, refused);
  const auto read = ParseOctomap(file, prior.bytes);
  if (!read.ok() || SameResolution(read->map.grid().resolution_m(), resolution_m)) return status;
  return absl::Status(status.code(), absl::StrCat(status.message(), "; --resample converts it"));
}

Json AsJson(const Versioned& scene, const Prior& prior, double resolution_m) {
  Json json = ToJson(scene);
  json["resampled"] = prior.resampled_from_m
                          ? Json{{"from_m", *prior.resampled_from_m}, {"to_m", resolution_m}}
                          : Json();
  return json;
}

std::string AsText(const Versioned& scene, const Prior& prior, const std::string& file,
                   double resolution_m) {
  std::string text = absl::StrCat("loaded ", file, " (", Bytes(prior.bytes.size()));
  if (prior.resampled_from_m) {
    absl::StrAppend(&text, ", resampled from voxels of ", NumberText(*prior.resampled_from_m),
                    " m to ", NumberText(resolution_m), " m");
  }
  return absl::StrCat(text, ") into scene version ", scene.version, "\n");
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  auto prior = ReadPrior(flags.file);
  if (!prior.ok()) return prior.status();
  const auto connection = Connect(flags.server);
  if (!connection.ok()) return connection.status();
  const double resolution_m = (*connection)->server().params.resolution_m;
  if (flags.resample) {
    if (auto status = ResampleTo(resolution_m, flags.file, *prior); !status.ok()) return status;
  }
  const auto scene = SceneClient(*connection).LoadPrior(prior->format, prior->bytes);
  if (!scene.ok()) return WithAdvice(scene.status(), flags.file, *prior, resolution_m);
  if (flags.json) {
    Print(terminal.out, AsJson(*scene, *prior, resolution_m));
  } else {
    terminal.out << AsText(*scene, *prior, flags.file, resolution_m);
  }
  return absl::OkStatus();
}

}  // namespace

void AddLoadPrior(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "load-prior", "Send a known static map to the server",
                                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command->add_option("file", flags->file, "OctoMap file (.bt, .ot)")->required();
  command->add_flag(
      "--resample", flags->resample,
      "Convert a map whose voxels have another size than the\nserver's: occupied where "
      "any of the map is, free where\nall of it is, else unknown. Overlaps of up to a\nthousandth "
      "of the "
      "smaller voxel do not count");
  command->add_flag("--json", flags->json, "Print JSON");
  AddServerFlags(command, &flags->server);
}

}  // namespace clearway::cli
