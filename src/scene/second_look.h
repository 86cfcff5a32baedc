// Labels that were believed, asked again when more is known.
#pragma once

#include <Eigen/Core>
#include <span>

#include "clearway/map/voxel_map.h"
#include "scene/object_update.h"

namespace clearway {

// Points of the frames before, of that stamp, were believed to be static (LabelDoubts). The static
// map forgets what it has of those that lie in an object as it is known by now, where it was then:
// voxels of which it knows no more than one hit tells. What is hit again, as the ground beside an
// object at rest is, is no wrong label's doing.
//
// Objects without a pose of exactly that stamp are left out, unless `between_poses`: then they are
// where they were between two poses.
void ForgetFilled(std::span<const Eigen::Vector3f> believed_W, Time stamp, const ObjectMap& objects,
                  VoxelMap& static_map_W, bool between_poses = false);

}  // namespace clearway
