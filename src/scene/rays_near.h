// The rays of a frame that pass near an object.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// In O, cut to the part that lies in a box.
struct ClippedRays {
  std::vector<Eigen::Vector3f> ends_O, origins_O;
  std::vector<RayEnd> kinds;      // kBlock where something is in the box, kClear at its border
  std::vector<std::uint32_t> of;  // which rays of the frame they are, as indices into its cloud

  RayCloud Cloud() const { return {ends_O, kinds, origins_O}; }
};

// Of each ray of the cloud, whether it may pass the ball: 1, or 0.
std::vector<std::uint8_t> RaysNear(const LabelledCloud& cloud, const Eigen::Vector3d& center_W,
                                   double radius_m);

// With O at that pose.
ClippedRays RaysWithin(const Aabb& box_O, const Pose& T_W_O, const LabelledCloud& cloud,
                       const SceneParams& params);

}  // namespace clearway
