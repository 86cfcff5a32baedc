// What one frame does to the scene's objects (II-D).
#pragma once

#include "clearway/base/thread_pool.h"
#include "clearway/scene/scene_builder.h"
#include "scene/earlier_views.h"
#include "scene/given_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"

namespace clearway {

// They refer to both.
ClueMap CluesOf(const Frame& frame, const LabelledCloud& cloud);

// The objects that are still the same ones in this frame. Of the others, which are dropped or begin
// anew, the static map forgets the free space that they touch. Clues under other ids come to stand
// under first ones, implausible motions are left out, and clues of points alone tell where these
// put the object.
ObjectMap Continuing(const SceneObjects& objects, const LabelledCloud& cloud, Time stamp,
                     const SceneParams& params, const FrameLimits& limits, EarlierViews& views,
                     ClueMap& clues, VoxelMap& static_map_W, FrameReport& report);

// Moves them, adds their points, and begins new ones; parts go along with their wholes.
void UpdateObjects(const Frame& frame, const LabelledCloud& cloud, ClueMap clues,
                   const SceneParams& params, ThreadPool& pool, ObjectMap& objects,
                   FrameReport& report);

}  // namespace clearway
