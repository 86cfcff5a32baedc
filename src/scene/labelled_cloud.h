// The points of a frame, sorted by what becomes of them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/map/ray.h"
#include "clearway/scene/frame.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// The usable points of a frame in W. Single precision, as OctoMap's points are, so that the same
// voxels result. A value.
struct LabelledCloud {
  std::vector<Eigen::Vector3f> ends_W;
  std::vector<RayEnd> kinds;  // as the static map takes them: an object's points block
  std::vector<ObjectId> labels;
  std::vector<Eigen::Vector3f> origins_W;  // one for all, or one per point
  // Per object, its points in range, as indices into the arrays above.
  std::map<ObjectId, std::vector<std::uint32_t>> object_hits;

  RayCloud Rays() const { return {ends_W, kinds, origins_W}; }
};

// The ends of those points, in W.
std::vector<Eigen::Vector3d> EndsOf(const LabelledCloud& cloud,
                                    std::span<const std::uint32_t> points);

// Leaves out the points with label -1, points that are not finite, on the robot's own body, points
// outside the bounds; counts them in `report`.
LabelledCloud PlaceCloud(const Frame& frame, const SceneParams& params, FrameReport& report);

}  // namespace clearway
