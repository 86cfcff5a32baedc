// Objects that go by several ids, because they were lost and seen again (SceneParams::reidentify).
#pragma once

#include <map>
#include <memory>
#include <set>

#include "clearway/base/thread_pool.h"
#include "clearway/scene/moving_object.h"
#include "scene/given_object.h"
#include "scene/object_update.h"

namespace clearway {

// What the frame says of an object under other ids counts for its first one. Returns the objects of
// which two ids have points in this frame: they are two after all, and their clues stay as they
// are.
std::set<ObjectId> GatherUnderFirstIds(const SceneObjects& objects,
                                       std::map<ObjectId, ObjectClue>& clues);

// Joins objects that were first seen not long ago to those they are, which were lost before.
// Nothing is joined that could be one of two. Returns how many were.
std::size_t JoinSeenAgain(std::map<ObjectId, std::shared_ptr<const MovingObject>>& objects,
                          Time stamp, const SceneParams& params, ThreadPool& pool);

}  // namespace clearway
