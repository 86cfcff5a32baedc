// Where a scan fits the static map.
#pragma once

#include "clearway/map/voxel_map.h"
#include "clearway/scene/frame.h"
#include "clearway/scene/scene_params.h"
#include "clearway/scene/world_corrections.h"

namespace clearway {

// T_W_V at the frame's stamp, for a valid frame of the source's world V: with it the static points
// fit the map best, and the sensor is not far from where the source says, nor from where it says
// that the sensor has gone since the newest of the corrections so far. Where by both of these fewer
// than fifty of the points that are looked at lie near the map, they alone decide; the identity
// without any correction so far.
Pose RegisterWorld(const Frame& frame_V, const VoxelMap& static_map_W,
                   const WorldCorrections& before, const SceneParams& params);

}  // namespace clearway
