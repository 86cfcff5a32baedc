// The frames that integration is measured on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "clearway/scene/frame.h"

namespace clearway::bench {

// Whole 360 degree scans of 64 beams: the first `count` of the real drive kitti0000_full where the
// recordings are, else of the simulator's street (and it says so). Labels are all 0.
std::vector<Frame> WholeScans(std::size_t count);

// The part of the scans that the camera sees, with the labels and motions of the moving objects:
// the first `count` of kitti0000_fov, else of the simulator's street.
std::vector<Frame> LabelledScans(std::size_t count);

// Depth images of 640 x 480 pixels of the simulator's lab, with labels and motions.
std::vector<Frame> DepthFrames(std::size_t count);

// The points that are in a map's frame W in single precision, as the static map takes them: all but
// those to be left out.
std::vector<Eigen::Vector3f> PointsInWorld(const Frame& frame);

}  // namespace clearway::bench
