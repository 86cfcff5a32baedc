// What a segmentation does not see.
#pragma once

#include <set>

#include "clearway/scene/frame.h"

namespace clearway {

// The frame of a source that takes these objects for a part of the static world, and says nothing
// of their motions and poses.
Frame WithoutObjects(Frame frame, const std::set<ObjectId>& missed);

// The frame of a source that takes objects of several parts for rigid ones: it says the main part's
// motion of all of it.
Frame WithoutParts(Frame frame);

}  // namespace clearway
