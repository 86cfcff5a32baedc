// clearway simulate: a simulated drive as a recording.
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/io/file_type.h"
#include "clearway/io/recording.h"
#include "clearway/sim/scenarios.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/message.h"
#include "cli/open_source.h"
#include "cli/progress.h"
#include "cli/text.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway simulate crossing --out crossing.cwr\n"
    "  clearway simulate street --seed 7 --noise table1 --frames 200 --out street.cwr";

struct Flags {
  std::string scenario;
  std::string out;
  bool force = false;
  bool json = false;
  SourceFlags source;
};

struct Written {
  std::size_t frames = 0;
  std::uint64_t points = 0;
};

absl::StatusOr<Written> WriteAll(const FrameSource& source, RecordingWriter& writer,
                                 const Terminal& terminal) {
  ProgressBar progress(terminal.err, terminal.err_is_terminal, source.frame_count);
  Written written;
  absl::Status status;
  while (status.ok() && written.frames < source.frame_count) {
    const auto frame = source.read(written.frames);
    status = frame.ok() ? writer.Append(*frame) : frame.status();
    if (!status.ok()) break;
    ++written.frames;
    written.points += frame->points_S.size();
    progress.Update(written.frames, written.points);
  }
  progress.Finish();
  if (status.ok()) status = writer.Close();
  if (!status.ok()) return status;
  return written;
}

// The scenarios' names, in lines that fit beside the argument's own name in `--help`.
std::string NamesInLines() {
  constexpr std::size_t kLine = 56;
  std::string lines;
  std::size_t line = 0;
  for (const std::string& name : ScenarioNames()) {
    const bool fits = line + name.size() < kLine;
    if (line > 0) absl::StrAppend(&lines, fits ? "|" : "|\n");
    line = (fits ? line + 1 : 0) + name.size();
    absl::StrAppend(&lines, name);
  }
  return lines;
}

// Names that people, and other programs, take for another kind of file.
absl::Status CheckName(const std::string& out) {
  const std::string extension = LowerExtension(out);
  if (HasMapExtension(out) || extension == ".ply" || extension == ".pcd") {
    return UsageError(absl::StrCat("--out: '", out, "' is the name of a ",
                                   HasMapExtension(out) ? "map" : "point cloud",
                                   "; name a recording, as drive.cwr"));
  }
  if (out.starts_with("sim:")) {
    return UsageError(absl::StrCat("--out: '", out, "' names a simulation, not a file"));
  }
  return absl::OkStatus();
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  if (auto status = CheckName(flags.out); !status.ok()) return status;
  const auto simulation = OpenSimulation(flags.scenario, flags.source);
  if (!simulation.ok()) return simulation.status();
  const FrameSource source = simulation->Frames();

  RecordingOptions options;
  options.description = source.description;
  options.resolution_m = source.resolution_m;
  options.overwrite = flags.force;
  auto writer = RecordingWriter::Create(flags.out, options);
  if (absl::IsAlreadyExists(writer.status())) {
    return absl::AlreadyExistsError(absl::StrCat(flags.out, " exists; --force replaces it"));
  }
  if (!writer.ok()) return writer.status();
  const auto written = WriteAll(source, **writer, terminal);
  if (!written.ok()) return written.status();

  if (flags.json) {
    Print(terminal.out, {{"file", flags.out},
                         {"scenario", simulation->spec().name},
                         {"seed", flags.source.seed},
                         {"noise", flags.source.noise},
                         {"frames", written->frames},
                         {"points", written->points},
                         {"resolution_m", source.resolution_m}});
  } else {
    terminal.out << "wrote " << flags.out << ": " << Plural(written->frames, "frame") << ", "
                 << Plural(written->points, "point") << "\n"
                 << "send it to a server with: clearway replay " << flags.out << "\n";
  }
  return absl::OkStatus();
}

}  // namespace

void AddSimulate(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "simulate", "Write a simulated drive as a recording",
                                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command->add_option("scenario", flags->scenario, NamesInLines())->required();
  command->add_option("-o,--out", flags->out, "The recording to write")->required();
  command->add_flag("--force", flags->force, "Replace a file that exists");
  command
      ->add_option("--objects", flags->source.objects,
                   "What frames say of objects: motions, poses or none")
      ->check(CLI::IsMember({"motions", "poses", "none"}).description(""))
      ->capture_default_str();
  AddSimulationFlags(command, &flags->source);
  command->add_flag("--json", flags->json, "Print a summary as JSON");
}

}  // namespace clearway::cli
