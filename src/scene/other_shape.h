// Whether what is seen is another object than a lost one, by the shapes of both.
#pragma once

#include "clearway/map/voxel_map.h"
#include "clearway/scene/moving_object.h"

namespace clearway {

// Whether `young` is not `lost`, whose frame L would be in its frame Y so (T_Y_L), by what rays
// passed and hit around it (`around_Y`, in Y; see SeenAround). So it is if
// - rays passed through more than an eighth of the voxels of `lost` that were passed or lie where
//   `young` is. Voxels count as passed with all occupied ones that touch them (an edge that rays
//   graze is passed on one side alone) and with what lies further in (a flat face that they graze
//   is not passed);
// - `lost` had an end, two layers of voxels or more across an axis of L, where rays passed;
// - `young` reaches two layers or more beyond all that was ever seen of `lost`, above, below, or
//   along the longer of that one's x and y: it is another, too, if `lost` was seen in part.
bool HasOtherShape(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                   const VoxelMap& around_Y);

}  // namespace clearway
