// Random scenes, robots, states and options, the same for the same seed.
#pragma once

#include <cstdint>
#include <random>

#include "clearway/collision/state_checker.h"
#include "collision/test_world.h"

namespace clearway {

// Draws from one generator: the order of the calls matters.
class RandomWorld {
 public:
  explicit RandomWorld(std::uint32_t seed) : random_(seed) {}

  // A region of about 4 x 4 x 2 m with free, occupied and unknown voxels, keep-out boxes, and
  // moving, turning and resting objects, some with a future, some given; both kinds of solid occur.
  ScenePtr Scene();
  Shape AnyShape();
  Shape ShapeOfKind(std::size_t kind);  // an index of Shape
  // One to three links of one or two shapes.
  Robot AnyRobot();
  // In the region and a little out of it; times from the past to beyond the horizon, few distinct.
  StateBatch States(const Robot& robot, int count);
  CheckOptions Options(const Robot& robot);

  double Uniform(double low, double high) {  // not the library's: the same on every machine
    return low + (high - low) * (random_() * (1.0 / 4294967296.0));
  }
  int Below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  Eigen::Vector3d Point(const Aabb& box);
  Pose AnyPose(const Aabb& box);

 private:
  std::vector<VoxelKey> Blob();
  std::vector<StampedPose> Future(double after_s);

  std::mt19937 random_;
};

}  // namespace clearway
