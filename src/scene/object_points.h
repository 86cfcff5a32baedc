// What a frame's points add to the map of an object that is placed.
#pragma once

#include <span>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"

namespace clearway {

// Adds the object's points to its own map, each voxel of O at most once; with
// params.clear_objects_by_rays also the misses of every ray through what was hit before; with a
// completed hull also what the view tells of its completion.
void AddPoints(MovingObject& object, const LabelledCloud& cloud,
               std::span<const std::uint32_t> points, Time stamp, const SceneParams& params,
               ThreadPool& pool);

}  // namespace clearway
