// Objects that go by several ids, because they were lost and seen again (SceneParams::reidentify).
#pragma once

#include <map>
#include <memory>
#include <set>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "clearway/scene/scene_builder.h"
#include "scene/given_object.h"
#include "scene/labelled_cloud.h"
#include "scene/object_update.h"
#include "scene/surroundings.h"

namespace clearway {

// An id by which an object was not told of for the object lifetime, and which is not its newest,
// names it no more if the frame uses it: that is another object, by an id that is free again.
SceneObjects WithoutLapsedIds(SceneObjects objects, const ClueMap& clues, Time stamp,
                              const SceneParams& params);

// What the frame says of an object under other ids counts for its first one: the points of the id
// that has most, and its motion or pose, else that of the newest id which has one. The report names
// other motions and poses (kMotionConflict). Returns the objects of which two ids have points in
// this frame (more than a few strays): they are two after all, and their clues stay as they are.
std::set<ObjectId> GatherUnderFirstIds(const SceneObjects& objects, ClueMap& clues,
                                       FrameReport& report);

// Those of the objects that were dropped before, and of all that were there before, that are no
// longer among the objects, but may be what was first seen not long ago.
SceneObjects DroppedLately(const SceneObjects& dropped_before, const SceneObjects& before,
                           const ObjectMap& objects, Time stamp, const SceneParams& params);

// Joins objects that were first seen not long ago to those they are, which were lost before.
// Nothing is joined that could be one of two, dropped ones included, nor what is a part of
// something or has parts, nor what, laid on the lost one as well as it can be, is not near where
// that one was to be, or has another shape by what was seen around both (`around`, of all that are
// not given: see SeenAround), or was met by too few beams of that stamp's cloud to tell. Returns
// how many were.
std::size_t JoinSeenAgain(ObjectMap& objects, const SceneObjects& dropped_lately,
                          const LabelledCloud& cloud, Time stamp, const Surroundings& around,
                          const SceneParams& params, ThreadPool& pool);

}  // namespace clearway
