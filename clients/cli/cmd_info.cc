// clearway info: what a file or folder holds.
#include <memory>

#include "cli/commands.h"
#include "cli/file_info.h"

namespace clearway::cli {
namespace {

constexpr char kExamples[] =
    "  clearway info crossing.cwr\n"
    "  clearway info ~/data/kitti0000_fov --poses oxts\n"
    "  clearway info ~/data/drive_in_utm --origin first\n"
    "  clearway info ~/data/rgbd_dataset_freiburg3_walking_xyz\n"
    "  clearway info ~/data/semantic_kitti/sequences/08\n"
    "  clearway info ~/data/pcd_with_poses --label-field instance\n"
    "  clearway info map.bt\n"
    "  clearway info sim:street --json";

struct Flags {
  std::string spec;
  SourceFlags source;
  bool json = false;
};

absl::StatusOr<FileInfo> InfoOf(const Flags& flags) {
  switch (KindOf(flags.spec)) {
    case SourceKind::kSimulation:
      return InfoOfSimulation(flags.spec, flags.source);
    case SourceKind::kLidarFolder:
      return InfoOfLidarFolder(flags.spec, flags.source);
    case SourceKind::kOctomap: {
      const auto status = CheckSourceFlags(flags.source, flags.spec, SourceFormat::kOctomap);
      return status.ok() ? InfoOfOctomap(flags.spec) : status;
    }
    case SourceKind::kRecording:
      break;
  }
  return InfoOfRecording(flags.spec, flags.source);
}

absl::Status Run(const Flags& flags, const Terminal& terminal) {
  const auto info = InfoOf(flags);
  if (!info.ok()) return info.status();
  if (flags.json) {
    Print(terminal.out, info->json);
  } else {
    terminal.out << info->text;
  }
  return absl::OkStatus();
}

}  // namespace

void AddInfo(Cli& cli) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = AddCommand(cli, "info", "Show what a recording, folder or map holds",
                                 kExamples, [flags, &cli] { return Run(*flags, cli.terminal); });
  command
      ->add_option(
          "input", flags->spec,
          "A recording, a folder of LiDAR scans (CARLA's, too), a\nKITTI, TUM RGB-D or ClusterSLAM "
          "sequence, PCD or PLY\nfiles with poses, DynoSAM's logs, an OctoMap file (.bt,\n.ot), or "
          "sim:NAME")
      ->required();
  AddPosesFlag(command, &flags->source);
  AddCloudFlags(command, &flags->source);
  AddOriginFlag(command, &flags->source);
  command->add_flag("--json", flags->json, "Print JSON");
}

}  // namespace clearway::cli
