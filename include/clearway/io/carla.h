// Recordings of the driving simulator CARLA: scans of its semantic LiDAR.
#pragma once

#include <filesystem>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// Whether the folder has a carla_sensor.csv.
bool IsCarla(const std::filesystem::path& folder);

// Reads the scans that CARLA's sensor.lidar.ray_cast_semantic saves, and two tables of our own,
// for CARLA writes no poses: carla_sensor.csv, where the sensor was at each frame, and
// carla_actors.csv, where its actors were. docs/formats.md has all of them.
//
// CARLA's frames are left-handed (y to the right); files are as CARLA gives them, and everything
// here is mirrored into x forward, y left, z up.
//
// Every actor with a row in carla_actors.csv, at whatever frame, is an object: points whose ObjIdx
// is its id have it as their label in all frames. Those of an actor of the type "ego" are left out
// (kIgnoreLabel). All others are static, whatever their ObjIdx: CARLA has ids for traffic lights
// and signs, too. Without a carla_actors.csv everything is static. Frames are CARLA's numbers.
//
// As the repository carla-simulator/carla writes and describes them: Docs/ref_sensors.md and
// Docs/coordinate_conventions.md; PLY files in LibCarla/source/carla/pointcloud/PointCloudIO.h and
// LibCarla/source/carla/sensor/data/SemanticLidarData.h.
//
// LidarFolderOptions::poses does not matter. Errors as OpenLidarFolder's.
absl::StatusOr<LidarFolder> OpenCarla(const std::filesystem::path& folder,
                                      const LidarFolderOptions& options = {});

}  // namespace clearway
