// Whether two objects are two, by the shape of one and what was seen around the other.
#pragma once

#include "clearway/map/voxel_map.h"
#include "clearway/scene/moving_object.h"

namespace clearway {

// Whether `object`, whose frame O would be in frame P of `other` (T_P_O) if they were the same, is
// not, by what rays passed and hit around `other` (`around_P`, in P; see SeenAround). So it is if
// - rays passed through more than an eighth of the voxels of `object` that were passed or lie where
//   `other` is. Voxels count as passed with all occupied ones that touch them (an edge that rays
//   graze is passed on one side alone) and with what lies further in (a flat face that they graze
//   is not passed);
// - `object` has an end, two layers of voxels or more across an axis of O, where rays passed.
bool IsSeenThrough(const MovingObject& object, const MovingObject& other, const Pose& T_P_O,
                   const VoxelMap& around_P);

}  // namespace clearway
