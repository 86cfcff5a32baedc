// How well the solids that a scene predicts agree with the true ones.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "clearway/report/met_surfaces.h"
#include "clearway/report/true_bodies.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// Counts of voxels, over many predictions: of those whose centre lies in the predicted solid, how
// many lie in the true one; of those in the part of the true one that was seen, how many lie in the
// predicted one; and of those in the whole true one. Either may be off by a voxel.
struct SolidOverlap {
  std::int64_t predicted = 0, predicted_right = 0;
  std::int64_t seen = 0, seen_found = 0;
  std::int64_t whole = 0, whole_found = 0;

  // Shares of 0 to 1; NaN of nothing. The F-score is their harmonic mean.
  double Precision() const {
    return static_cast<double>(predicted_right) / static_cast<double>(predicted);
  }
  double Recall() const { return static_cast<double>(seen_found) / static_cast<double>(seen); }
  double FScore() const { return 2 / (1 / Precision() + 1 / Recall()); }
  double WholeRecall() const {
    return static_cast<double>(whole_found) / static_cast<double>(whole);
  }
  double WholeFScore() const { return 2 / (1 / Precision() + 1 / WholeRecall()); }

  SolidOverlap& operator+=(const SolidOverlap& other);
};

// Collects overlaps over the versions of a scene. Predicted is what an object
// fills (params.solid), where the scene predicts it. Seen is what lies both in the body and in the
// convex hull of the voxels that rays met of it: of what no ray has met nothing is known. Parts
// of a body that the scene does not have as objects are taken for the body's own. Voxels
// are as large as those of the object's map, in W. A prediction is left out if its box, or that
// around the bodies, holds more than 2^24 of them. One thread.
class SolidScore {
 public:
  // Predictions of times after `end`, and of those when a body's place is not known, are left out.
  SolidScore(TrueBodies bodies, Time end, std::vector<Duration> ahead);

  // The version after a frame, and what was met until then. Objects count that were seen in it.
  void Add(const SceneSnapshot& scene, const MetSurfaces& met);

  // By object, in the order of `ahead`.
  const std::map<ObjectId, std::vector<SolidOverlap>>& overlaps() const { return overlaps_; }

 private:
  TrueBodies bodies_;
  Time end_;
  std::vector<Duration> ahead_;
  std::map<ObjectId, std::vector<SolidOverlap>> overlaps_;
};

}  // namespace clearway
