// What is told of objects and not seen: shapes with a pose, and futures.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "clearway/geometry/shape.h"
#include "clearway/scene/moving_object.h"

namespace clearway {

// An object of known shape that somebody adds to a scene: another robot, a door, a person as a
// cylinder. Its frame O is the shape's frame G. Plain data.
struct GivenObject {
  ObjectId id = 0;  // above 0, of no object in the scene
  Shape shape;      // a TriangleMesh must be convex
  StampedPose pose;
  std::optional<Twist> velocity_O;  // of its motion on from there; none: it is at rest
  std::vector<StampedPose> future;  // as MovingObject::future
};

// Where an object will be, known or stated. Other parts of the same object (Frame::parts) go along.
struct ObjectFuture {
  ObjectId id = 0;
  std::vector<StampedPose> poses;  // none: what was stated before is withdrawn
};

inline constexpr std::size_t kMaxFuturePoses = 10'000;
inline constexpr std::size_t kMaxGivenTriangles = 2'000;  // of a mesh
inline constexpr double kMaxGivenSpin_radps = 100;

}  // namespace clearway
