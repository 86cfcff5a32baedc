// Points at times of their own.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "absl/container/flat_hash_map.h"
#include "clearway/map/voxel_reader.h"
#include "clearway/scene/object_index.h"
#include "clearway/scene/occupancy.h"

namespace clearway {

// The occupancy of points at many times on one version: what SceneAtTime says, but an object is
// placed at a time only for points that it may have reached. One thread. It must not outlive the
// snapshot.
class TimedScene {
 public:
  // For times in [first, last].
  TimedScene(const SceneSnapshot& scene, Time first, Time last);

  PointOccupancy At(const Eigen::Vector3d& p_W, Time time);
  // The same for many points, which is faster: the spans are of one size.
  void At(std::span<const Eigen::Vector3d> points_W, std::span<const Time> times,
          std::span<PointOccupancy> answers);
  // As CastQueryRay at that time. Ends soon after `cancelled`, which is asked every so often, says
  // so; then the answer means nothing.
  RayAnswer CastRay(const Eigen::Vector3d& origin_W, const Eigen::Vector3d& direction_W,
                    double max_range_m, Time time, const std::function<bool()>& cancelled);

 private:
  const SceneAtTime::Placed& Placed(std::size_t object, Time time);
  void AddObjects(const Eigen::Vector3d& p_W, Time time, PointOccupancy& answer);

  const SceneSnapshot& scene_;
  ObjectIndex index_;
  VoxelReader static_map_;
  std::vector<Eigen::Vector3d> addressable_W_;
  // By object and time, the ones asked for lately.
  absl::flat_hash_map<std::pair<std::size_t, std::int64_t>, SceneAtTime::Placed> placed_;
};

}  // namespace clearway
