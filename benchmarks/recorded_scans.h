// The scans that integration is measured on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/scene/frame.h"

namespace clearway::bench {

// Whole 360 degree scans of 64 beams: the first `count` of the real drive kitti0000_full where the
// recordings are, else of the simulator's street (and it says so). Labels are all 0.
std::vector<Frame> WholeScans(std::size_t count);

// The points in W in single precision, as the static map takes them.
std::vector<Eigen::Vector3f> PointsInWorld(const Frame& frame);

}  // namespace clearway::bench
