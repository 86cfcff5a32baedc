// What is still to be driven of motions.
#pragma once

#include <vector>

#include "clearway/collision/motion.h"

namespace clearway {

struct MotionRest {
  MotionBatch motions;
  std::vector<std::size_t> indices;  // of each: which it is the rest of
};

// The motions from `now` on; those that end by then are left out. The motions must be valid, for a
// robot of so many links.
MotionRest RestOf(const MotionBatch& motions, std::size_t links, Time now);

}  // namespace clearway
