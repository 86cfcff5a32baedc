// Objects that were lost behind something and are seen again under another id.
#pragma once

#include <optional>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// Where the frame L of `lost` is in the frame Y of `young` (T_Y_L) if that is the same object:
// where `young` was first seen its voxels fit those of `lost`, near where that one was to be then;
// both are about as large, as far as `young` was seen; and both go about alike. None if `young` may
// be another one, or one of them has been seen too little to tell. `lost` must not have been seen
// since `young` was first.
std::optional<Pose> SeenAgain(const MovingObject& lost, const MovingObject& young,
                              const SceneParams& params);

// `lost` as it goes on, at the stamp, with the voxels and poses of `young`, and with what was
// stated of its future. It keeps its id and its frame; the ids of `young` name it too.
MovingObject Joined(const MovingObject& lost, const MovingObject& young, const Pose& T_Y_L,
                    Time stamp, const SceneParams& params, ThreadPool& pool);

}  // namespace clearway
