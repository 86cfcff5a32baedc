// The true surfaces that rays met.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>

#include "absl/container/flat_hash_map.h"
#include "clearway/report/true_bodies.h"
#include "clearway/scene/frame.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// Collects them, where points of a body lie in its frame, in pieces of the size of a voxel. What a
// map can know is judged by them: not by what no ray has met. One thread.
class MetSurfaces {
 public:
  // The first point in each voxel of a body's frame B.
  using Pieces = absl::flat_hash_map<VoxelKey, Eigen::Vector3d>;

  explicit MetSurfaces(TrueBodies bodies) : bodies_(std::move(bodies)) {}

  // A frame, of true labels, whose points were taken from T_W_S in truth, and the version after it.
  // Returns beyond the scene's range count as none. Of an object whose map was begun in this frame,
  // what was met before is forgotten. Points of objects that are nowhere in truth are left out, and
  // so are those that lie more than kBeside_m outside their body's box: a label alone is no truth.
  static constexpr double kBeside_m = 0.5;
  void Add(const Frame& frame, const Pose& T_W_S, const SceneSnapshot& scene);

  // Of an object; of the static world, whose B is W, if the id is 0.
  const Pieces& Of(ObjectId id) const;

 private:
  TrueBodies bodies_;
  std::map<ObjectId, Pieces> met_;
};

}  // namespace clearway
