// Others that an object which was lost and is seen again could be as well.
#pragma once

#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_params.h"

namespace clearway {

// Whether `young`, which fits `lost`, may be `other`, which was lost too, or `lost` may be `other`,
// which was seen since: however long that one is known by now.
bool IsRival(const MovingObject& other, const MovingObject& lost, const MovingObject& young,
             Time stamp, const SceneParams& params);

}  // namespace clearway
