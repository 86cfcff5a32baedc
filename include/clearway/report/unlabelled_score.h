// What becomes of movers that nobody labelled.
#pragma once

#include <cstdint>
#include <set>

#include "absl/container/flat_hash_set.h"
#include "clearway/report/truth.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// Counts over the frames of a sequence. A plain value.
struct Unlabelled {
  std::int64_t frames = 0;
  // Points of the movers within range; and of these in voxels that the static map calls occupied
  // right after the frame.
  std::int64_t points = 0, points_occupied = 0;
  // Voxels that they left and that no static point was in, but that the static map calls occupied
  // for good: after each frame together, after the worst one, and after the last one.
  std::int64_t trail = 0, most_trail = 0, last_trail = 0;
  // Voxels of dynamic space, after each frame together; and of these those that they left, and
  // those where none of them ever was.
  std::int64_t dynamic = 0, dynamic_left = 0, dynamic_elsewhere = 0;

  // NaN of nothing.
  double ShareOccupied() const { return Share(points_occupied, points); }
  double MeanTrail() const { return Share(trail, frames); }

 private:
  static double Share(std::int64_t part, std::int64_t all) {
    return static_cast<double>(part) / static_cast<double>(all);
  }
};

// Judges by true labels and true boxes. One thread.
class UnlabelledScore {
 public:
  UnlabelledScore(Truth truth, std::set<ObjectId> movers)
      : truth_(std::move(truth)), movers_(std::move(movers)) {}

  // The frame, of true labels, and the version after it.
  void Add(const Frame& frame, const SceneSnapshot& scene);

  const Unlabelled& Result() const { return counts_; }

 private:
  void AddPoints(const Frame& frame, const SceneSnapshot& scene);
  void CountLeft(const Frame& frame, const SceneSnapshot& scene);

  Truth truth_;
  std::set<ObjectId> movers_;
  absl::flat_hash_set<VoxelKey> of_movers_, of_static_;  // with a point so far
  Unlabelled counts_;
};

}  // namespace clearway
