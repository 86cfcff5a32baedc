// How large an object is.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "clearway/scene/moving_object.h"

namespace clearway {

// How far apart the smallest and the greatest of the values are, and what lies in the middle of
// them, without the outermost 0.5 % at each end: a few voxels that a wrong label or pose has left
// are not what makes an object large. There must be a value.
struct Span1d {
  double length = 0, middle = 0;
};
Span1d SpanOf(std::vector<double> values);

// An upright box around an object. A value.
struct ObjectExtent {
  double yaw_rad = 0;                                // of the box's length in O, about O's z
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  // length, width, height
  Eigen::Vector3d center_O = Eigen::Vector3d::Zero();
};

// The object's size: the SpanOf the centres of its occupied voxels, at least a voxel each way,
// along the axes of the smallest upright box around them. Points lie anywhere in their voxels, so
// that is the best guess of how far apart the surfaces are, while the voxels' corners
// (Solid::box_O, what collision checking uses) stick out of them. Its length, the longer side,
// points forwards if the object moves. A given object's is the box around its solid. All zero for
// an object without an occupied voxel. The smallest rectangle shares a side with the outline:
// Freeman and Shapira, "Determining the Minimum-Area Encasing Rectangle for an Arbitrary Closed
// Curve", 1975.
ObjectExtent ExtentOf(const MovingObject& object);

// A part of an object (MovingObject::part_of), P being its frame.
struct PlacedPart {
  const MovingObject* object;
  Pose T_O_P;
};
// The same around the object and its parts.
ObjectExtent ExtentOf(const MovingObject& object, std::span<const PlacedPart> parts);

}  // namespace clearway
