// A sensor's rays against a world.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "clearway/sim/world.h"
#include "sim/mesh_bvh.h"

namespace clearway {

// What one ray met first.
struct RayHit {
  double range_m = 0;    // infinite: nothing
  std::size_t body = 0;  // index into the world's bodies; meaningless without a hit
};

// Casts rays against all bodies of a world, which must outlive it. Immutable; any thread may call
// it.
class RayCaster {
 public:
  explicit RayCaster(const World& world);

  // One answer per unit direction in S, for the sensor at T_W_S and time t. Of surfaces at the same
  // distance the first body counts.
  std::vector<RayHit> Cast(const Pose& T_W_S, Time t, std::span<const Eigen::Vector3d> directions_S,
                           double max_range_m) const;

 private:
  struct Target {
    std::size_t body;
    const BodyPart* part;
    std::shared_ptr<const MeshBvh> bvh;  // of a TriangleMesh
    Eigen::Vector3d center_B;            // of a ball around the part
    double radius_m;
  };
  struct Placed;
  std::vector<Placed> Place(const Pose& T_W_S, Time t, double max_range_m) const;

  const World* world_;
  std::vector<Target> targets_;
};

}  // namespace clearway
