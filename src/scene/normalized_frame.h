// Frames whose rotations were rounded.
#pragma once

#include <optional>

#include "clearway/scene/frame.h"

namespace clearway {

// A copy with rotations of length 1, if those of the frame are not, but for rounding. For a valid
// frame.
std::optional<Frame> Renormalized(const Frame& frame);

}  // namespace clearway
