// Objects that are not where they are thought to be, for what lies behind is seen.
#pragma once

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// Whether `young`, which the cloud's frame sees, is not `lost`, whose frame L would be in its frame
// Y so (T_Y_L): rays pass through more than a fifth of the voxels of `lost` that are passed, or
// lie where `young` is. Voxels count as passed with all occupied ones that touch them: what rays
// graze is passed on one side alone.
bool WouldBeSeenThrough(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                        const LabelledCloud& cloud, const SceneParams& params, ThreadPool& pool);

}  // namespace clearway
