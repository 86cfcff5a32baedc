// Every kind of source of frames behind one function.
#pragma once

#include <filesystem>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/frame_source.h"
#include "clearway/io/lidar_folder.h"
#include "clearway/sim/simulation.h"
#include "cli/source_flags.h"

namespace clearway::cli {

// What a text names: a file by its content, or by its extension if its content does not tell.
enum class SourceKind { kSimulation, kLidarFolder, kOctomap, kRecording };
SourceKind KindOf(const std::string& spec);

// Whether a file's name is that of an OctoMap file: .bt or .ot, in any case of letters.
bool HasMapExtension(const std::filesystem::path& path);

// All that open something refuse flags that are for other kinds of source, as CheckSourceFlags.

// "sim:crossing", or "crossing"; NOT_FOUND lists the scenarios.
absl::StatusOr<Simulation> OpenSimulation(const std::string& spec, const SourceFlags& flags);

// Of LiDAR scans, also of CARLA's, a sequence of KITTI's tracking or odometry benchmark, TUM's
// RGB-D benchmark or the ClusterSLAM dataset, point clouds with a table of poses, or DynoSAM's
// logs. `allow_missing_points`: as in LidarFolderOptions.
absl::StatusOr<LidarFolder> OpenFolder(const std::string& path, const SourceFlags& flags,
                                       bool allow_missing_points);

// A recording, a folder as OpenFolder takes it, or "sim:<scenario>". Errors as the readers';
// INVALID_ARGUMENT for a map, which holds no frames.
absl::StatusOr<FrameSource> OpenSource(const std::string& spec, const SourceFlags& flags);

}  // namespace clearway::cli
