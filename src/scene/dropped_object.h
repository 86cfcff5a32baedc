// What remains of an object that was not seen for too long.
#pragma once

#include "clearway/scene/moving_object.h"

namespace clearway {

// Makes the free voxels of the static map that the object's solid, at its last pose, may touch
// unknown again: it may still be there, for nobody has looked. New rays make them free again.
void ForgetFreeSpaceOf(const MovingObject& object, VoxelMap& map_W);

}  // namespace clearway
