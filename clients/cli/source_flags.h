// Choices about a source of frames, and which kinds of source each is for.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "absl/status/status.h"
#include "clearway/io/world_origin.h"
#include "clearway/scene/frame.h"

namespace clearway::cli {

enum class SourceFormat {
  kSimulation,
  kLidarFolder,
  kCarla,
  kKittiTracking,
  kKittiOdometry,
  kCloudFolder,
  kTumRgbd,
  kClusterSlam,
  kDynosam,
  kRecording,
  kOctomap
};

struct SourceFlags {
  // Simulator.
  std::uint64_t seed = 1;
  std::string noise = "none";
  std::optional<std::size_t> frames;
  double range_noise_m = 0;
  std::optional<int> beams;
  bool keep_no_return = false;
  bool allow_missing_points = false;
  // LiDAR folders and KITTI tracking.
  std::string poses = "any";
  // Folders of point clouds.
  std::string label_field, pose_table;
  // KITTI odometry.
  std::string parked = "static";
  // TUM RGB-D sequences; the second of ClusterSLAM's, too.
  std::uint32_t stride = 1;
  std::optional<double> max_depth_m;
  // All that are no recordings.
  std::string objects = "motions";
  // All but simulations.
  std::optional<WorldOrigin> origin;

  // Knows which flags were given. Null if these are no flags, but read from a file.
  const CLI::App* command = nullptr;
};

void AddSimulationFlags(CLI::App* command, SourceFlags* flags);
void AddPosesFlag(CLI::App* command, SourceFlags* flags);
void AddCloudFlags(CLI::App* command, SourceFlags* flags);  // and those of KITTI odometry
void AddOriginFlag(CLI::App* command, SourceFlags* flags);
void AddSourceFlags(CLI::App* command, SourceFlags* flags);  // those of every kind

// "first", or "x,y,z" in metres.
absl::StatusOr<WorldOrigin> ParseOrigin(const std::string& text);
// "x,y,z" alone, each within kMaxFileCoordinate_m.
absl::StatusOr<Eigen::Vector3d> ParseOriginPoint(const std::string& text);

// A usage error names a flag that was given and what it is for, if the source `spec` is of another
// kind. All flags of the command count that are for some kinds alone.
absl::Status CheckSourceFlags(const SourceFlags& flags, const std::string& spec,
                              SourceFormat format);

// What a source holds, for flags that are about it.
struct SourceContent {
  std::set<ObjectId> objects;
  bool has_parts = false;
  bool has_beams = false;
};
// The same of flags that name what the source does not hold.
absl::Status CheckSourceContent(const SourceFlags& flags, const std::string& spec,
                                const SourceContent& content);

}  // namespace clearway::cli
