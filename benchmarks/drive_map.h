// The map that queries are measured on, once as ours and once as OctoMap's.
#pragma once

#include <octomap/OcTree.h>

#include <memory>
#include <random>
#include <vector>

#include "clearway/scene/scene_snapshot.h"

namespace clearway::bench {

// The static map of the first `scans` whole scans (see WholeScans), voxels of 0.1 m, range 50 m,
// and the same voxels in two pruned OctoMaps. Scans were inserted into `tree`, as they are on a
// robot. `read_tree` was read from a file, which lays parents and children side by side in memory:
// searches of it are up to twice as fast.
struct DriveMap {
  ScenePtr scene;
  std::shared_ptr<octomap::OcTree> tree, read_tree;
  Aabb box_W;  // around what is observed within 20 m of the first scan
};
DriveMap MakeDriveMap(std::size_t scans);

// Frames, the last of them at `last`, 0.1 s apart, in which a sensor at `center_W` sees the corners
// of `count` moving objects of 2 x 2 x 2 m, in a square around it and 5 m apart; each goes its own
// way at 1 m/s. To be applied without a limit of range.
std::vector<Frame> FramesWithObjects(Time last, int count, const Eigen::Vector3d& center_W,
                                     int frames);

// Around those objects, 5 m high; the same density for any count that is a square.
Aabb CrowdBox(int count, const Eigen::Vector3d& center_W);

// The scene with all those objects besides.
ScenePtr WithObjects(const SceneSnapshot& scene, int count, const Eigen::Vector3d& center_W);

class Dice {
 public:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Eigen::Vector3d PointIn(const Aabb& box) {
    const double x = Uniform(box.min.x(), box.max.x()), y = Uniform(box.min.y(), box.max.y());
    return {x, y, Uniform(box.min.z(), box.max.z())};
  }
  Eigen::Quaterniond Rotation() {
    const double w = normal_(engine_), x = normal_(engine_), y = normal_(engine_);
    return Eigen::Quaterniond(w, x, y, normal_(engine_)).normalized();
  }

 private:
  std::mt19937_64 engine_{1};
  std::normal_distribution<double> normal_;
};

}  // namespace clearway::bench
