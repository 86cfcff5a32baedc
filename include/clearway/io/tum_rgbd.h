// Sequences of depth images in the layout of the TUM RGB-D benchmark.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

struct TumRgbdOptions {
  // As in LidarFolderOptions; frames are numbered as in depth.txt, from 0.
  LidarObjects objects = LidarObjects::kMotions;
  Duration motions_over = Duration::zero();
  int first_frame = 0;
  int last_frame = std::numeric_limits<int>::max();
  bool allow_missing_points = false;
  std::string sensor_id = "camera";
  // As in DepthImage.
  std::uint32_t stride = 1;
  std::optional<double> max_depth_m = std::nullopt;
};

// Whether the folder has a depth.txt.
bool IsTumRgbd(const std::filesystem::path& folder);

// Reads depth.txt, the 16-bit PNG images that it names, and groundtruth.txt
// (https://cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats; Sturm et al., "A Benchmark for
// the Evaluation of RGB-D SLAM Systems", 2012). S is the camera's optical frame: x right, y down, z
// forward. An image's pose is interpolated between the poses around it, of which the nearer one
// must be within 0.02 s; if they are more than 0.1 s apart, the nearer one is it. Images without a
// pose are left out.
//
// Of our own: camera.txt, the intrinsics (else those published for freiburg1, 2 and 3, by the
// folder's name); mask.txt, a list of PNG images whose values are object ids (0 static), and images
// without a mask are left out; object_poses.txt, T_W_B over time, whose entries become `boxes`
// without a size. docs/formats.md has all of them.
//
// Errors as OpenLidarFolder's.
absl::StatusOr<LidarFolder> OpenTumRgbd(const std::filesystem::path& folder,
                                        const TumRgbdOptions& options = {});

}  // namespace clearway
