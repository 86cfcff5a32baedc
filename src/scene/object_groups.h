// Objects that are parts of others (Frame::parts): which belong together, and what a frame says of
// the one by the other.
#pragma once

#include <set>
#include <vector>

#include "absl/status/status.h"
#include "scene/given_object.h"
#include "scene/object_update.h"

namespace clearway {

// FAILED_PRECONDITION naming the part, if with what the frame says a part of one of the scene's
// objects would have parts.
absl::Status CheckParts(const Frame& frame, const SceneObjects& objects);

// Makes the objects parts of others, or of none. Those that are not there are left out.
void SetParts(const std::vector<ObjectPart>& parts, ObjectMap& objects);

// Ids of objects that belong together, two or more: that of the main part first, if it is there,
// then ascending.
using ObjectGroup = std::vector<ObjectId>;
std::vector<ObjectGroup> GroupsOf(const SceneObjects& objects);
std::vector<ObjectGroup> GroupsOf(const ObjectMap& objects);

// What the frame implies of the objects that it does not place itself: that they moved as an object
// of their group did. `before` and `now`: the scene's objects before the frame, and with those
// moved that it places.
std::vector<ObjectMotion> MotionsAlong(const ObjectMap& before, const ObjectMap& now,
                                       const ClueMap& clues, Time stamp);

// After all objects were moved: parts go on as the object does that the frame places, the main part
// before others.
void GoAlong(const ClueMap& clues, Time stamp, const SceneParams& params, ObjectMap& objects);

}  // namespace clearway
