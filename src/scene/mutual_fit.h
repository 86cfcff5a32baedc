// Where the maps of what may be one object agree best.
#pragma once

#include "clearway/geometry/pose.h"
#include "clearway/map/voxel_map.h"

namespace clearway {

// `T_Y_L`, a guess of where the frame L of one map is in that of another, Y, mended so that voxels
// of Y lie on those of L, and those of L not where rays passed Y (`around_Y`, in Y). It is sought
// within eight voxels of the guess along x and y, and about z, which is taken to point up: how high
// and how level things are the guess knows, and whatever may be tilted fits too much. Some 400
// voxels of each map are looked at: of vehicles and people it takes 1 to 30 ms, the longer the
// farther the guess is off.
Pose MutualFit(const VoxelMap& map_L, const VoxelMap& map_Y, const VoxelMap& around_Y,
               const Pose& T_Y_L);

}  // namespace clearway
