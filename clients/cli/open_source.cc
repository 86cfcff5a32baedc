#include "cli/open_source.h"

#include <filesystem>
#include <map>

#include "absl/strings/str_cat.h"
#include "clearway/io/carla.h"
#include "clearway/io/cluster_slam.h"
#include "clearway/io/dynosam.h"
#include "clearway/io/kitti_tracking.h"
#include "clearway/io/recording.h"
#include "clearway/io/tum_rgbd.h"
#include "clearway/sim/scenarios.h"
#include "cli/cli.h"

namespace clearway::cli {
namespace {

constexpr char kSimulationPrefix[] = "sim:";

// The checks of the flags leave no other texts.
LidarPoses LidarPosesOf(const std::string& text) {
  if (text == "icp") return LidarPoses::kIcp;
  if (text == "oxts") return LidarPoses::kOxts;
  if (text == "plain") return LidarPoses::kPlain;
  return LidarPoses::kAny;
}

LidarObjects LidarObjectsOf(const std::string& text) {
  if (text == "poses") return LidarObjects::kPoses;
  return text == "none" ? LidarObjects::kNone : LidarObjects::kMotions;
}

ObjectReport ObjectReportOf(const std::string& text) {
  if (text == "poses") return ObjectReport::kPoses;
  return text == "none" ? ObjectReport::kNothing : ObjectReport::kMotions;
}

absl::StatusOr<LidarFolder> OpenTum(const std::string& path, const SourceFlags& flags,
                                    bool allow_missing_points) {
  return OpenTumRgbd(path, {.objects = LidarObjectsOf(flags.objects),
                            .allow_missing_points = allow_missing_points,
                            .stride = flags.stride,
                            .max_depth_m = flags.max_depth_m});
}

absl::StatusOr<LidarFolder> OpenCluster(const std::string& path, const SourceFlags& flags,
                                        bool allow_missing_points) {
  return OpenClusterSlam(path, {.objects = LidarObjectsOf(flags.objects),
                                .allow_missing_points = allow_missing_points,
                                .max_depth_m = flags.max_depth_m});
}

}  // namespace

void AddSimulationFlags(CLI::App* command, SourceFlags* flags) {
  const char* const group = "Simulator";
  command->add_option("--seed", flags->seed, "Seed of all noise")
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
  command->add_option("--beams", flags->beams, "Beams of its LiDAR: 16, 32 or 64")
      ->check(CLI::IsMember({16, 32, 64}).description(""))
      ->group(group);
  command
      ->add_flag("--keep-no-return", flags->keep_no_return,
                 "Rays that meet nothing clear space up to their range")
      ->group(group);
}

void AddSourceFlags(CLI::App* command, SourceFlags* flags) {
  command
      ->add_option("--objects", flags->objects,
                   "What frames say of objects: motions, poses or none\n"
                   "(simulator and folders)")
      ->check(CLI::IsMember({"motions", "poses", "none"}).description(""))
      ->capture_default_str()
      ->group("Source");
  command
      ->add_option("--poses", flags->poses,
                   "A LiDAR folder's tables: icp, oxts, plain, or any\n(the first there is)")
      ->check(CLI::IsMember({"any", "plain", "icp", "oxts"}).description(""))
      ->capture_default_str()
      ->group("Source");
  command
      ->add_flag("--allow-missing-points", flags->allow_missing_points,
                 "Take frames of a folder that have a pose but no file of\npoints as frames "
                 "without points")
      ->group("Source");
  command
      ->add_option("--stride", flags->stride,
                   "Of a TUM RGB-D sequence's images, use every n-th column\nand row")
      ->check(CLI::Range(1, 65'535).description(""))
      ->capture_default_str()
      ->group("Source");
  command
      ->add_option("--max-depth", flags->max_depth_m,
                   "Of a TUM RGB-D or ClusterSLAM sequence, leave out what is\nfarther, in metres")
      ->check(Between(0.001, 1e6))
      ->group("Source");
  AddSimulationFlags(command, flags);
}

SourceKind KindOf(const std::string& spec) {
  if (spec.starts_with(kSimulationPrefix)) return SourceKind::kSimulation;
  const std::filesystem::path path(spec);
  std::error_code error;
  if (std::filesystem::is_directory(path, error) || IsDynosam(path)) {
    return SourceKind::kLidarFolder;
  }
  const std::string extension = path.extension().string();
  if (extension == ".bt" || extension == ".ot") return SourceKind::kOctomap;
  return SourceKind::kRecording;
}

absl::StatusOr<Simulation> OpenSimulation(const std::string& spec, const SourceFlags& flags) {
  const std::string name =
      spec.starts_with(kSimulationPrefix) ? spec.substr(sizeof(kSimulationPrefix) - 1) : spec;
  ScenarioOptions options;
  options.seed = flags.seed;
  options.range_noise_m = flags.range_noise_m;
  options.report = ObjectReportOf(flags.objects);
  options.keep_no_return = flags.keep_no_return;
  options.frame_count = flags.frames;
  options.beams = flags.beams;
  if (flags.noise == "table1") {
    // The noise depends on the time between frames, which is the scenario's.
    const auto exact = MakeScenario(name, options);
    if (!exact.ok()) return exact.status();
    options.noise = SlamNoise::TableOne(exact->spec().period);
  }
  return MakeScenario(name, options);
}

absl::StatusOr<LidarFolder> OpenFolder(const std::string& path, const SourceFlags& flags,
                                       bool allow_missing_points) {
  if (IsTumRgbd(path)) return OpenTum(path, flags, allow_missing_points);
  if (IsDynosam(path)) {
    return OpenDynosam(path, {.objects = LidarObjectsOf(flags.objects),
                              .allow_missing_points = allow_missing_points});
  }
  if (IsClusterSlam(path)) return OpenCluster(path, flags, allow_missing_points);
  LidarFolderOptions options;
  options.poses = LidarPosesOf(flags.poses);
  options.objects = LidarObjectsOf(flags.objects);
  options.allow_missing_points = allow_missing_points;
  if (IsCarla(path)) return OpenCarla(path, options);
  return IsKittiTracking(path) ? OpenKittiTracking(path, options) : OpenLidarFolder(path, options);
}

absl::StatusOr<FrameSource> OpenSource(const std::string& spec, const SourceFlags& flags) {
  switch (KindOf(spec)) {
    case SourceKind::kSimulation: {
      const auto simulation = OpenSimulation(spec, flags);
      if (!simulation.ok()) return simulation.status();
      return simulation->Frames();
    }
    case SourceKind::kLidarFolder: {
      const auto folder = OpenFolder(spec, flags, flags.allow_missing_points);
      if (!folder.ok()) return folder.status();
      return folder->frames;
    }
    case SourceKind::kOctomap:
      return absl::InvalidArgumentError(absl::StrCat(
          spec, ": a map holds no frames; 'clearway load-prior' sends it to a server"));
    case SourceKind::kRecording:
      break;
  }
  return OpenRecording(spec);
}

}  // namespace clearway::cli
