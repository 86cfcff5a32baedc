// Masks of a segmentation that are larger than what they are of.
#pragma once

#include "clearway/scene/frame.h"

namespace clearway {

// The frame with the label of an object on every static point that the sensor sees within this
// angle of one of the object's (the nearest's, if there are several): what is around and behind it.
// Rays without a return keep their label.
Frame WithBleedingMasks(Frame frame, double bleed_rad);

}  // namespace clearway
