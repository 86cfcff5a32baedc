// clearway record: the frames of any source as a recording.
#include <memory>

#include "cli/commands.h"
#include "cli/json.h"
#include "cli/left_out_text.h"
#include "cli/open_source.h"
#include "cli/write_recording.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway record ~/data/kitti0000_fov --poses icp --objects poses --out drive.cwr\n"
    "  clearway record ~/data/drive_in_utm --origin first --from 10s --to 20s --out drive.cwr";

struct Flags {
  std::string spec;
  std::string out;
  SourceFlags source;
  FrameRangeFlags range;
  bool force = false;
  bool keep_going = false;
  bool json = false;
};

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  if (auto status = CheckRecordingName(flags.out); !status.ok()) return status;
  const auto source = OpenSource(flags.spec, flags.source);
  if (!source.ok()) return source.status();
  const auto range = FramesIn(flags.range, flags.spec, *source);
  if (!range.ok()) return range.status();
  FrameReader reader(*source, flags.keep_going);
  const auto written = WriteRecording(*source, reader, *range, flags.out, flags.force, terminal);
  if (!written.ok()) return written.status();
  if (!source->left_out->Empty()) terminal.err << "warning: " << LeftOutText(*source->left_out);
  if (flags.json) {
    Print(terminal.out, {{"file", flags.out},
                         {"source", source->description},
                         {"frames", written->frames},
                         {"points", written->points},
                         {"resolution_m", source->resolution_m},
                         {"origin_m", ToJson(source->origin_m)},
                         {"left_out", ToJson(*source->left_out)}});
  } else {
    PrintWritten(terminal.out, flags.out, *written);
  }
  return reader.Result();
}

}  // namespace

void AddRecord(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "record", "Write the frames of a data set as a recording",
                                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command
      ->add_option("source", flags->spec,
                   "What 'clearway replay' takes: a folder of a data set,\nanother recording or "
                   "sim:NAME")
      ->required();
  command->add_option("-o,--out", flags->out, "The recording to write")->required();
  command->add_flag("--force", flags->force, "Replace a file that exists");
  AddKeepGoingFlag(command, &flags->keep_going);
  AddFrameRangeFlags(command, &flags->range);
  command->add_flag("--json", flags->json, "Print a summary as JSON");
  AddSourceFlags(command, &flags->source);
}

}  // namespace clearway::cli
