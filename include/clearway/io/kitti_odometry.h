// Sequences of the KITTI odometry benchmark, with SemanticKITTI's labels.
#pragma once

#include <cstdint>
#include <filesystem>

#include "absl/status/statusor.h"
#include "clearway/io/lidar_folder.h"

namespace clearway {

// What becomes of points of vehicles and persons that do not move in the sequence.
enum class ParkedObjects { kStatic, kObjects };

struct KittiOdometryOptions {
  LidarFolderOptions frames;  // `poses` and `objects` do not matter: there are no boxes
  ParkedObjects parked = ParkedObjects::kStatic;
};

// Whether that is a sequence's folder: velodyne and calib.txt are in it.
bool IsKittiOdometry(const std::filesystem::path& sequence);

// Reads <sequence>/velodyne/NNNNNN.bin, calib.txt (Tr) and poses.txt, or poses/NN.txt beside
// `sequences` as the benchmark publishes it; times.txt, else 10 Hz. Geiger et al., "Are we ready
// for Autonomous Driving?", 2012; Behley et al., "SemanticKITTI", 2019. The table's poses are of
// the left camera; W is the velodyne's frame where they are the identity (x forward, z up).
//
// With labels/NNNNNN.label, points of moving classes (252 to 259) that have an instance are
// objects: id = 100000 times the class' number (1 car, 2 bicyclist, 3 person, 4 motorcyclist, 5 on
// rails, 6 bus, 7 truck, 8 other vehicle) + instance. Those without an instance, unlabeled ones (0)
// and outliers (1) are left out (kIgnoreLabel); all others are static. Without the folder all are
// static. The data has neither boxes nor motions. Errors as OpenLidarFolder's.
absl::StatusOr<LidarFolder> OpenKittiOdometry(const std::filesystem::path& sequence,
                                              const KittiOdometryOptions& options = {});

// The object of a label's 32 bits: class in the lower half, instance in the upper.
ObjectId SemanticKittiObject(std::uint32_t label, ParkedObjects parked);

}  // namespace clearway
