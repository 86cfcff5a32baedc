// What a segmentation gets wrong.
#pragma once

#include <cstdint>

#include "clearway/scene/frame.h"

namespace clearway {

// The frame with wrong labels on this share (0 to 1) of its points, each on its own: of those that
// the frame has (the static one too), another one, all equally likely. A point that is ignored, or
// a ray without a return, keeps its label. The same arguments give the same labels everywhere.
Frame WithWrongLabels(Frame frame, double share, std::uint64_t seed);

}  // namespace clearway
