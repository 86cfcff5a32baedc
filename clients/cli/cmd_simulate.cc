// clearway simulate: a simulated drive as a recording.
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "clearway/sim/scenarios.h"
#include "cli/commands.h"
#include "cli/json.h"
#include "cli/open_source.h"
#include "cli/write_recording.h"

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

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  if (auto status = CheckRecordingName(flags.out); !status.ok()) return status;
  const auto simulation = OpenSimulation(flags.scenario, flags.source);
  if (!simulation.ok()) return simulation.status();
  const FrameSource source = simulation->Frames();

  FrameReader reader(source, /*keep_going=*/false);
  const auto written = WriteRecording(source, reader, FrameRange{0, source.frame_count}, flags.out,
                                      flags.force, terminal);
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
    PrintWritten(terminal.out, flags.out, *written);
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
