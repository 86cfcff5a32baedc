// How large the maps of objects are, compared with the true boxes.
#pragma once

#include <map>
#include <memory>

#include "clearway/report/mean_pose.h"
#include "clearway/report/truth.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// Lengths along the axes of the true box, x along its length, in metres.
struct BoxFit {
  Eigen::Vector3d true_m = Eigen::Vector3d::Zero();
  // SpanOf the centres of occupied voxels (scene/object_extent.h).
  Eigen::Vector3d mapped_m = Eigen::Vector3d::Zero();

  // Of the axis where they differ most. What no ray has met is missing in the map.
  double WorstDifference_m() const { return (mapped_m - true_m).cwiseAbs().maxCoeff(); }
};

// Collects the newest map of each object. Where its frame lies in the box is taken to be the mean
// over the frames since the map was begun. One thread.
class BoxFitter {
 public:
  explicit BoxFitter(Truth truth) : truth_(std::move(truth)) {}

  // The version after a frame. Objects count that the frame shows, unless their pose is bridged.
  void Add(const SceneSnapshot& scene);

  // Of every object seen so far, dropped ones too.
  std::map<ObjectId, BoxFit> Fits() const;

 private:
  struct Seen {
    std::shared_ptr<const MovingObject> object;
    MeanPose T_O_B;
    Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  };

  Truth truth_;
  std::map<ObjectId, Seen> seen_;
};

}  // namespace clearway
