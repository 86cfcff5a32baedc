// How well the maps of objects fit the true objects.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "clearway/report/mean_pose.h"
#include "clearway/report/met_surfaces.h"
#include "clearway/report/true_bodies.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

struct ObjectFit {
  double voxel_m = 0;
  // From the centre of each occupied voxel to the nearest true surface, in metres, ascending. Of
  // recorded boxes: to the nearest face.
  std::vector<double> errors_m;
  // Pieces, of the size of a voxel, of the true surface that rays met; and of these the ones with
  // an occupied voxel at most half a voxel away. Of recorded boxes a piece is a place in the box
  // where a point of the object was measured, as the box lay then: it shows how much of what was
  // measured the map kept, smeared by as much as the boxes jitter; not what no ray has met, and not
  // whether what was measured is the object's.
  std::size_t met = 0, covered = 0;
  // Occupied voxels after each frame in which it was seen.
  std::vector<std::int64_t> growth;

  // The error that this share (0 to 1) of the voxels does not exceed; NaN without any.
  double Quantile_m(double share) const;
  double Accuracy_m() const { return Quantile_m(0.5); }
  double Completeness() const;  // covered of met; NaN without any

  // Takes over another object's voxels and pieces; the growth stays.
  ObjectFit& operator+=(const ObjectFit& other);
};

// Of all objects of a scene.
struct SceneFit {
  ObjectFit together;
  double worst_accuracy_voxels = 0;  // of the object whose median error is the largest
  double worst_completeness = 1;     // of the object that is covered worst
};

SceneFit Together(const std::map<ObjectId, ObjectFit>& fits);

// Collects the newest map of each object. Where its frame O lies in the true body, as scans show
// that, is taken to be the mean over the frames since the map was begun: what the source gets wrong
// about the object's place, and the sensor's, is no fault of the map's. One thread.
class ObjectFitter {
 public:
  explicit ObjectFitter(TrueBodies bodies) : bodies_(std::move(bodies)) {}

  // The version after a frame. T_R_W: from W to where the frame's scan shows it, by what the source
  // gets wrong about the sensor's pose.
  void Add(const SceneSnapshot& scene, const Pose& T_R_W);

  // Of every object seen so far, dropped ones too.
  std::map<ObjectId, ObjectFit> Fits(const MetSurfaces& met) const;

 private:
  struct Seen {
    std::shared_ptr<const MovingObject> object;
    MeanPose T_O_B;
    std::vector<std::int64_t> growth;
  };
  ObjectFit FitOf(const Seen& seen, const MetSurfaces::Pieces& met_B) const;

  TrueBodies bodies_;
  std::map<ObjectId, Seen> seen_;
};

}  // namespace clearway
