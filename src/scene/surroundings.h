// What scans show around objects that may have been lost before, or may be lost.
#pragma once

#include <map>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// By id of an object, in its O: what lies beside it, and, of a young one (IsYoung), where one of
// those that were lost before would be if it were that one.
using Surroundings = std::map<ObjectId, VoxelMap>;

// With what the rays of that stamp's cloud pass and hit about those of the objects of which is
// known where they are then: of young ones at each scan, beside all others now and then. What is no
// longer there is left out, and so is what is given.
Surroundings SeenAround(const Surroundings& before, const ObjectMap& objects,
                        const LabelledCloud& cloud, Time stamp, const SceneParams& params,
                        ThreadPool& pool);

}  // namespace clearway
