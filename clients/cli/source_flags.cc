#include "cli/source_flags.h"

#include <filesystem>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "cli/cli.h"
#include "cli/message.h"
#include "cli/values.h"

namespace clearway::cli {
namespace {

constexpr char kSourceGroup[] = "Source (each for the kinds that it names)";

constexpr unsigned Bit(SourceFormat format) { return 1U << static_cast<unsigned>(format); }

constexpr unsigned kSimulation = Bit(SourceFormat::kSimulation);
constexpr unsigned kTum = Bit(SourceFormat::kTumRgbd);
constexpr unsigned kTumOrCluster = kTum | Bit(SourceFormat::kClusterSlam);
constexpr unsigned kLidarTables =
    Bit(SourceFormat::kLidarFolder) | Bit(SourceFormat::kKittiTracking);
constexpr unsigned kOdometry = Bit(SourceFormat::kKittiOdometry);
constexpr unsigned kClouds = Bit(SourceFormat::kCloudFolder);
constexpr unsigned kWithObjects =
    kLidarTables | kTumOrCluster | Bit(SourceFormat::kCarla) | Bit(SourceFormat::kDynosam);
constexpr unsigned kDataSets = kWithObjects | kOdometry | kClouds;

// The flags that are not for every kind of source.
struct Applies {
  const char* flag;
  unsigned formats;
  const char* what_for;
};
constexpr Applies kApplies[] = {
    {"--seed", kSimulation, "seeds simulations (sim:NAME)"},
    {"--noise", kSimulation, "is the noise of simulations (sim:NAME)"},
    {"--range-noise", kSimulation, "is the noise of ranges in simulations (sim:NAME)"},
    {"--frames", kSimulation, "is the length of simulations (sim:NAME)"},
    {"--beams", kSimulation, "is for the LiDARs of simulations (sim:NAME)"},
    {"--keep-no-return", kSimulation, "is for rays of simulations (sim:NAME)"},
    {"--parts", kSimulation, "is for simulations with objects of parts (sim:articulated)"},
    {"--objects", kSimulation | kWithObjects,
     "is for simulations (sim:NAME) and data sets with poses or motions of objects"},
    {"--origin", kDataSets | Bit(SourceFormat::kRecording),
     "moves the world of data sets and recordings"},
    {"--label-field", kClouds, "names a field of PCD and PLY files"},
    {"--pose-table", kClouds, "names the poses of a folder of PCD or PLY files"},
    {"--parked", kOdometry, "is about SemanticKITTI's labels"},
    {"--allow-missing-points", kWithObjects | kOdometry,
     "is for data sets whose files of points may be missing"},
    {"--poses", kLidarTables, "chooses a table of a folder of LiDAR scans"},
    {"--stride", kTum, "thins out the images of TUM RGB-D sequences"},
    {"--max-depth", kTumOrCluster, "limits the depths of TUM RGB-D and ClusterSLAM sequences"},
};

const char* NameOf(SourceFormat format) {
  switch (format) {
    case SourceFormat::kSimulation:
      return "a simulation";
    case SourceFormat::kLidarFolder:
      return "a folder of LiDAR scans";
    case SourceFormat::kCarla:
      return "a folder of CARLA's scans";
    case SourceFormat::kKittiTracking:
      return "a sequence of KITTI's tracking benchmark";
    case SourceFormat::kKittiOdometry:
      return "a sequence of KITTI's odometry benchmark";
    case SourceFormat::kCloudFolder:
      return "a folder of point clouds";
    case SourceFormat::kTumRgbd:
      return "a TUM RGB-D sequence";
    case SourceFormat::kClusterSlam:
      return "a ClusterSLAM sequence";
    case SourceFormat::kDynosam:
      return "logs of DynoSAM";
    case SourceFormat::kRecording:
      return "a recording";
    case SourceFormat::kOctomap:
      break;
  }
  return "an OctoMap file";
}

// Null unless the command has the flag and the user gave it.
const CLI::Option* Given(const SourceFlags& flags, const char* flag) {
  if (flags.command == nullptr) return nullptr;
  const CLI::Option* const option = flags.command->get_option_no_throw(flag);
  return option != nullptr && option->count() > 0 ? option : nullptr;
}

}  // namespace

void AddSimulationFlags(CLI::App* command, SourceFlags* flags) {
  flags->command = command;
  const char* const group = "Simulator (of sim:NAME alone)";
  command
      ->add_option("--seed", flags->seed,
                   "Seed of all noise, and of the worlds of sim:occlusions,\n"
                   "sim:queues, sim:swaps and sim:far_swaps: other ones for\n"
                   "each seed")
      ->check(NotNegative())
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--noise", flags->noise,
                   "Errors of the simulated SLAM: none, or table1 (the paper's)")
      ->check(CLI::IsMember({"none", "table1"}).description(""))
      ->capture_default_str()
      ->group(group);
  command
      ->add_option("--range-noise", flags->range_noise_m,
                   "Standard deviation along each ray, in metres")
      ->check(Between(0, 1))
      ->group(group);
  command->add_option("--frames", flags->frames, "Number of frames (default: the scenario's)")
      ->check(CLI::Range(1, 1'000'000).description(""))
      ->group(group);
  command
      ->add_option("--beams", flags->beams,
                   "Beams of its LiDAR: 16, 32 or 64 (default: the scenario's)")
      ->check(CLI::IsMember({16, 32, 64}).description(""))
      ->group(group);
  command
      ->add_flag(
          "--keep-no-return", flags->keep_no_return,
          "Rays that meet nothing clear space up to their range\n(default: they are left out)")
      ->group(group);
}

void AddPosesFlag(CLI::App* command, SourceFlags* flags) {
  flags->command = command;
  command
      ->add_option("--poses", flags->poses,
                   "The tables of a folder of LiDAR scans: icp, oxts, plain,\nor any (the first "
                   "there is)")
      ->check(CLI::IsMember({"any", "plain", "icp", "oxts"}).description(""))
      ->capture_default_str()
      ->group(kSourceGroup);
}

void AddCloudFlags(CLI::App* command, SourceFlags* flags) {
  flags->command = command;
  command
      ->add_option("--label-field", flags->label_field,
                   "The field of a PCD's or PLY's points that holds the\nobject's id (0: static, "
                   "below 0: left out)")
      ->check([](const std::string& name) { return name.empty() ? "name a field" : ""; })
      ->type_name("FIELD")
      ->group(kSourceGroup);
  command
      ->add_option("--pose-table", flags->pose_table,
                   "The poses of a folder of PCD or PLY files, in TUM's or\nKITTI's format "
                   "(default: poses.txt or another usual name)")
      ->check(CLI::ExistingFile.description(""))
      ->type_name("FILE")
      ->group(kSourceGroup);
  command
      ->add_option("--parked", flags->parked,
                   "What vehicles and persons are that SemanticKITTI labels\nas not moving: static "
                   "or objects")
      ->check(CLI::IsMember({"static", "objects"}).description(""))
      ->capture_default_str()
      ->group(kSourceGroup);
}

void AddOriginFlag(CLI::App* command, SourceFlags* flags) {
  flags->command = command;
  AddParsed(command, "--origin", &flags->origin, ParseOrigin,
            "Subtract x,y,z from all coordinates of a data set's or\nrecording's world, as of UTM; "
            "first: where its sensor is\nfirst")
      ->type_name("ORIGIN")
      ->group(kSourceGroup);
}

absl::StatusOr<WorldOrigin> ParseOrigin(const std::string& text) {
  if (text == "first") return WorldOrigin{.at_first_pose = true};
  if (!ParsePoint(text).ok()) {
    return absl::InvalidArgumentError(
        absl::StrCat("expected first, or x,y,z in metres, not '", text, "'"));
  }
  const auto position_m = ParseOriginPoint(text);
  if (!position_m.ok()) return position_m.status();
  return WorldOrigin{.position_m = *position_m};
}

absl::StatusOr<Eigen::Vector3d> ParseOriginPoint(const std::string& text) {
  auto position_m = ParsePoint(text);
  if (!position_m.ok() || position_m->cwiseAbs().maxCoeff() <= kMaxFileCoordinate_m) {
    return position_m;
  }
  return absl::InvalidArgumentError(
      absl::StrCat("'", text, "' is beyond the limit of ", kMaxFileCoordinate_m, " m either way"));
}

void AddSourceFlags(CLI::App* command, SourceFlags* flags) {
  command
      ->add_option("--objects", flags->objects,
                   "What frames say of objects: motions, poses or none\n"
                   "(any source but recordings)")
      ->check(CLI::IsMember({"motions", "poses", "none"}).description(""))
      ->capture_default_str()
      ->group(kSourceGroup);
  AddPosesFlag(command, flags);
  AddCloudFlags(command, flags);
  AddOriginFlag(command, flags);
  command
      ->add_flag("--allow-missing-points", flags->allow_missing_points,
                 "Take frames of a folder or of logs that have a pose but no\nfile of points as "
                 "frames without points")
      ->group(kSourceGroup);
  command
      ->add_option("--stride", flags->stride,
                   "Of a TUM RGB-D sequence's images, use every n-th column\nand row")
      ->check(CLI::Range(1, 65'535).description(""))
      ->capture_default_str()
      ->group(kSourceGroup);
  command
      ->add_option("--max-depth", flags->max_depth_m,
                   "Of a TUM RGB-D or ClusterSLAM sequence, leave out what is\nfarther, in metres")
      ->check(Between(0.001, 1e6))
      ->group(kSourceGroup);
  AddSimulationFlags(command, flags);
}

absl::Status CheckSourceFlags(const SourceFlags& flags, const std::string& spec,
                              SourceFormat format) {
  std::error_code ignored;
  if (format == SourceFormat::kRecording && !std::filesystem::exists(spec, ignored)) {
    return absl::OkStatus();  // it is no recording either; what opens it will say so
  }
  for (const Applies& row : kApplies) {
    if ((row.formats & Bit(format)) != 0 || Given(flags, row.flag) == nullptr) continue;
    return UsageError(
        absl::StrCat(row.flag, " ", row.what_for, "; ", spec, " is ", NameOf(format)));
  }
  return absl::OkStatus();
}

absl::Status CheckSourceContent(const SourceFlags& flags, const std::string& spec,
                                const SourceContent& content) {
  if (Given(flags, "--parts") != nullptr && !content.has_parts) {
    return UsageError("--parts is for objects that consist of parts; " + spec + " has none");
  }
  if (Given(flags, "--beams") != nullptr && !content.has_beams) {
    return UsageError("--beams is for LiDARs; the sensor of " + spec + " is a depth camera");
  }
  const CLI::Option* const unlabelled = Given(flags, "--unlabelled");
  if (unlabelled == nullptr) return absl::OkStatus();
  for (const ObjectId id : unlabelled->as<std::vector<ObjectId>>()) {
    if (content.objects.contains(id)) continue;
    return UsageError(absl::StrCat("--unlabelled: ", spec, " has no object ", id, "; it has ",
                                   content.objects.empty() ? "none" : "",
                                   absl::StrJoin(content.objects, ", ")));
  }
  return absl::OkStatus();
}

}  // namespace clearway::cli
