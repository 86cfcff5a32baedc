// Voxels that a scan's rays only graze.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "clearway/base/thread_pool.h"
#include "clearway/map/scan_update.h"
#include "clearway/map/voxel_map.h"
#include "map/passed_voxels.h"
#include "map/surface_layers.h"

namespace clearway {

// A scan's rays in the map's frame, of which some end on something. Arrays are parallel.
struct EndingRays {
  static constexpr std::uint32_t kNotEnding = std::numeric_limits<std::uint32_t>::max();

  std::span<const Eigen::Vector3f> origins;  // one for all, or one per ray
  std::span<const Eigen::Vector3f> ends;
  std::span<const VoxelKey> voxels;       // of the ends
  std::span<const std::uint32_t> places;  // in the update, of the voxels' blocks; or kNotEnding
  std::span<const std::uint8_t> sectors;  // RaySector's
};

// Keeps its memory from one scan to the next. One thread at a time.
class GrazedVoxels {
 public:
  // Takes from the update of a map the misses that RayOptions::grazing_m speaks of. The result does
  // not depend on the number of threads.
  void Spare(const VoxelMap& map, const EndingRays& rays, double grazing_m, ThreadPool& pool,
             ScanUpdate& update);

 private:
  struct Stretch {
    RaySegment segment;  // from the ray's end back, where it spares what is occupied
    std::uint8_t sector;
  };
  void FindStretches(const VoxelGrid& grid, const SurfaceLayers& layers, const EndingRays& rays,
                     double grazing_m, ThreadPool& pool);

  std::vector<std::vector<Stretch>> stretches_;  // of so many rays each
  PassedVoxels passed_;
};

}  // namespace clearway
