// Every kind of source of frames behind one function.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/frame_source.h"
#include "clearway/io/lidar_folder.h"
#include "clearway/sim/simulation.h"

namespace clearway::cli {

// Choices about a source; those of another kind of source are ignored.
struct SourceFlags {
  // Simulator.
  std::uint64_t seed = 1;
  std::string noise = "none";
  std::optional<std::size_t> frames;
  double range_noise_m = 0;
  std::optional<int> beams;
  bool keep_no_return = false;
  bool allow_missing_points = false;
  // LiDAR folders.
  std::string poses = "any";
  // TUM RGB-D sequences; the second of ClusterSLAM's, too.
  std::uint32_t stride = 1;
  std::optional<double> max_depth_m;
  // All of them.
  std::string objects = "motions";
};

void AddSimulationFlags(CLI::App* command, SourceFlags* flags);
void AddSourceFlags(CLI::App* command, SourceFlags* flags);  // those of every kind

// What a text names.
enum class SourceKind { kSimulation, kLidarFolder, kOctomap, kRecording };
SourceKind KindOf(const std::string& spec);

// "sim:crossing", or "crossing"; NOT_FOUND lists the scenarios.
absl::StatusOr<Simulation> OpenSimulation(const std::string& spec, const SourceFlags& flags);

// Of LiDAR scans, also of CARLA's, a sequence of KITTI's tracking benchmark, TUM's RGB-D benchmark
// or the ClusterSLAM dataset, or DynoSAM's logs.
// `allow_missing_points`: as in LidarFolderOptions.
absl::StatusOr<LidarFolder> OpenFolder(const std::string& path, const SourceFlags& flags,
                                       bool allow_missing_points);

// A recording, a folder as OpenFolder takes it, or "sim:<scenario>". Errors as the readers';
// INVALID_ARGUMENT for a map, which holds no frames.
absl::StatusOr<FrameSource> OpenSource(const std::string& spec, const SourceFlags& flags);

}  // namespace clearway::cli
