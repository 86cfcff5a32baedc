// The slow reference of collision checks: every voxel box of every map, each tested by FCL.
#pragma once

#include <memory>
#include <vector>

#include "clearway/collision/state_checker.h"

namespace clearway {

// What a check should answer.
struct BruteAnswer {
  StateAnswer answer;
  // Something is within 1e-6 m of touching: the status may as well be another.
  bool unsure = false;
};

// The rules of state_checker.h written down once more, as plainly as possible. Shares with the
// checker the predicted poses, the solids of meshes, point-in-shape tests and FCL, but none of its
// searches, closed forms or bounds. Static voxels are looked at in `region_W` alone.
class BruteForce {
 public:
  BruteForce(ScenePtr scene, const Robot& robot, const CheckOptions& options, const Aabb& region_W);
  ~BruteForce();

  BruteAnswer Check(Time time, const Pose* T_W_L) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clearway
