// How an object is contradicted by what was seen around another that it might be.
#pragma once

#include "clearway/map/voxel_map.h"
#include "clearway/scene/moving_object.h"

namespace clearway {

// If `object` were `other`, and its frame O in that one's frame P so (T_P_O): of its voxels that
// rays passed or that lie where `other` is, the share that they passed, by what they passed and hit
// around `other` (`around_P`, in P; see SeenAround). Voxels count as passed with all occupied ones
// that touch them (an edge that rays graze is passed on one side alone) and with what lies further
// in (a flat face that they graze is not passed). All, 1, if they passed an end of `object`: two
// layers of voxels or more across an axis of O, or one of three or more of which the others lie
// between beams.
double ShareSeenThrough(const MovingObject& object, const MovingObject& other, const Pose& T_P_O,
                        const VoxelMap& around_P);

}  // namespace clearway
