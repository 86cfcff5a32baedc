// What scans show around objects that may have been lost before.
#pragma once

#include <map>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// By id of a young object (IsYoung), in its O: what lies about it, where one of those that were
// lost before would be if it were that one.
using Surroundings = std::map<ObjectId, VoxelMap>;

// With what the rays of that stamp's cloud pass and hit about those of the objects of which is
// known where they are then. What is no longer young is left out.
Surroundings SeenAround(const Surroundings& before, const ObjectMap& objects,
                        const LabelledCloud& cloud, Time stamp, const SceneParams& params,
                        ThreadPool& pool);

// Whether `young` is not `lost`, whose frame L would be in its frame Y so (T_Y_L): rays passed
// through more than an eighth of the voxels of `lost` that were passed or lie where `young` is.
// Voxels count as passed with all occupied ones that touch them (an edge that rays graze is passed
// on one side alone) and with what lies further in (a flat face that they graze is not passed).
bool WouldBeSeenThrough(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                        const VoxelMap& around_Y);

}  // namespace clearway
