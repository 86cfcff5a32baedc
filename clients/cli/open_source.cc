#include "cli/open_source.h"

#include <filesystem>
#include <variant>

#include "absl/strings/str_cat.h"
#include "clearway/io/carla.h"
#include "clearway/io/cloud_folder.h"
#include "clearway/io/cluster_slam.h"
#include "clearway/io/dynosam.h"
#include "clearway/io/file_type.h"
#include "clearway/io/kitti_odometry.h"
#include "clearway/io/kitti_tracking.h"
#include "clearway/io/recording.h"
#include "clearway/io/tum_rgbd.h"
#include "clearway/io/within_scene.h"
#include "clearway/sim/scenarios.h"

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

SourceFormat FormatOfFolder(const std::string& path) {
  if (IsTumRgbd(path)) return SourceFormat::kTumRgbd;
  if (IsDynosam(path)) return SourceFormat::kDynosam;
  if (IsClusterSlam(path)) return SourceFormat::kClusterSlam;
  if (IsCarla(path)) return SourceFormat::kCarla;
  if (IsKittiTracking(path)) return SourceFormat::kKittiTracking;
  if (IsKittiOdometry(path)) return SourceFormat::kKittiOdometry;
  return IsCloudFolder(path) ? SourceFormat::kCloudFolder : SourceFormat::kLidarFolder;
}

absl::StatusOr<LidarFolder> OpenFormat(SourceFormat format, const std::string& path,
                                       const SourceFlags& flags, bool allow_missing_points) {
  if (format == SourceFormat::kTumRgbd) return OpenTum(path, flags, allow_missing_points);
  if (format == SourceFormat::kClusterSlam) return OpenCluster(path, flags, allow_missing_points);
  if (format == SourceFormat::kDynosam) {
    return OpenDynosam(path, {.objects = LidarObjectsOf(flags.objects),
                              .allow_missing_points = allow_missing_points});
  }
  if (format == SourceFormat::kCloudFolder) {
    return OpenCloudFolder(path,
                           {.pose_table = flags.pose_table, .label_field = flags.label_field});
  }
  LidarFolderOptions options;
  options.poses = LidarPosesOf(flags.poses);
  options.objects = LidarObjectsOf(flags.objects);
  options.allow_missing_points = allow_missing_points;
  if (format == SourceFormat::kKittiOdometry) {
    return OpenKittiOdometry(path, {options, flags.parked == "objects" ? ParkedObjects::kObjects
                                                                       : ParkedObjects::kStatic});
  }
  if (format == SourceFormat::kCarla) return OpenCarla(path, options);
  if (format == SourceFormat::kKittiTracking) return OpenKittiTracking(path, options);
  return OpenLidarFolder(path, options);
}

SourceContent ContentOf(const Simulation& simulation) {
  SourceContent content;
  for (const ObjectId id : simulation.world().ObjectIds()) {
    content.objects.insert(id);
    content.has_parts |= simulation.world().FindObject(id)->part_of != kStaticLabel;
  }
  content.has_beams = std::holds_alternative<SpinningLidar>(simulation.spec().sensor);
  return content;
}

}  // namespace

SourceKind KindOf(const std::string& spec) {
  if (spec.starts_with(kSimulationPrefix)) return SourceKind::kSimulation;
  const std::filesystem::path path(spec);
  std::error_code error;
  if (std::filesystem::is_directory(path, error) || IsDynosam(path)) {
    return SourceKind::kLidarFolder;
  }
  switch (KindOfFile(path).type) {
    case FileType::kSqlite:
      return SourceKind::kRecording;
    case FileType::kOctomapBt:
    case FileType::kOctomapOt:
      return SourceKind::kOctomap;
    default:
      return HasMapExtension(path) ? SourceKind::kOctomap : SourceKind::kRecording;
  }
}

bool HasMapExtension(const std::filesystem::path& path) {
  const std::string extension = LowerExtension(path);
  return extension == ".bt" || extension == ".ot";
}

absl::StatusOr<Simulation> OpenSimulation(const std::string& spec, const SourceFlags& flags) {
  if (auto status = CheckSourceFlags(flags, spec, SourceFormat::kSimulation); !status.ok()) {
    return status;
  }
  const std::string name =
      spec.starts_with(kSimulationPrefix) ? spec.substr(sizeof(kSimulationPrefix) - 1) : spec;
  ScenarioOptions options;
  options.seed = flags.seed;
  options.range_noise_m = flags.range_noise_m;
  options.report = ObjectReportOf(flags.objects);
  options.keep_no_return = flags.keep_no_return;
  options.frame_count = flags.frames;
  const auto exact = MakeScenario(name, options);
  if (!exact.ok()) return exact.status();
  if (auto status = CheckSourceContent(flags, spec, ContentOf(*exact)); !status.ok()) return status;
  options.beams = flags.beams;
  // The noise depends on the time between frames, which is the scenario's.
  if (flags.noise == "table1") options.noise = SlamNoise::TableOne(exact->spec().period);
  return MakeScenario(name, options);
}

absl::StatusOr<LidarFolder> OpenFolder(const std::string& path, const SourceFlags& flags,
                                       bool allow_missing_points) {
  const SourceFormat format = FormatOfFolder(path);
  if (auto status = CheckSourceFlags(flags, path, format); !status.ok()) return status;
  auto folder = OpenFormat(format, path, flags, allow_missing_points);
  if (folder.ok()) folder = WithOrigin(*std::move(folder), flags.origin);
  if (folder.ok()) folder = WithinScene(*std::move(folder));
  if (!folder.ok()) return folder;
  SourceContent content;
  for (const RecordedBox& box : folder->boxes) content.objects.insert(box.id);
  if (auto status = CheckSourceContent(flags, path, content); !status.ok()) return status;
  return folder;
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
  if (auto status = CheckSourceFlags(flags, spec, SourceFormat::kRecording); !status.ok()) {
    return status;
  }
  auto recording = OpenRecording(spec);
  return recording.ok() ? WithOrigin(*std::move(recording), flags.origin) : recording;
}

}  // namespace clearway::cli
