// Objects that were lost behind something and are seen again under another id.
#pragma once

#include <optional>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// Where `lost` is at the stamp (T_W_O of its O) if `young`, which was seen there, is that object:
// its voxels fit those of `lost`, near where that one is predicted; both are about as large, as far
// as `young` was seen; and both go about alike, if that is known of both. None if `young` may be
// another one, or has been seen too little to tell. `lost` must not have been seen since `young`
// was first.
std::optional<Pose> SeenAgainAt(const MovingObject& lost, const MovingObject& young, Time stamp,
                                const SceneParams& params);

// `lost`, where it is at the stamp, with the voxels and poses of `young`. It keeps its id and O.
MovingObject Joined(MovingObject lost, const MovingObject& young, const Pose& T_W_O, Time stamp,
                    const SceneParams& params, ThreadPool& pool);

}  // namespace clearway
