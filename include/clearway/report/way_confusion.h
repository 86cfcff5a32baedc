// What a scene says of the places that objects pass, against who is really there.
#pragma once

#include <map>
#include <vector>

#include "absl/container/inlined_vector.h"
#include "clearway/report/confusion.h"
#include "clearway/report/truth.h"
#include "clearway/scene/scene_snapshot.h"

namespace clearway {

// Asks versions of a scene about a grid over the ways of all objects of a sequence: every fourth
// voxel, along each axis, whose centre one of their true boxes ever holds, looked at ten times a
// second. There it is known what is free:
// where an object has passed or will pass, nothing else stands. At a time, a place is truly
// occupied in the middle six tenths of a box, as no object fills its box, be it one that the scene
// has not seen yet; truly free farther than
// 0.3 m from every box, as boxes are not exact, if there is a box of every object that ever holds
// it. Else it is not counted, nor is what lies within 0.3 m of a box's bottom, the ground, or out
// of the sensor's range, or in boxes of more than 2^24 voxels. One thread.
class WayConfusion {
 public:
  WayConfusion(Truth truth, std::vector<Duration> ahead);

  // The version after a frame, and from where that was seen. Frames must come in order.
  void Add(const SceneSnapshot& scene, const Eigen::Vector3d& sensor_W);

  // In the order of `ahead`. Times after the truth's end are left out.
  const std::vector<Confusion>& Result() const { return confusions_; }
  // The same by object: an occupied place counts for those in the middle of which it lies, a free
  // one for each that passes it.
  const std::map<ObjectId, std::vector<Confusion>>& ByObject() const { return by_object_; }

 private:
  using Ids = absl::InlinedVector<ObjectId, 2>;
  // A voxel that objects pass.
  struct Place {
    Eigen::Vector3d center_W;
    Ids passed_by;
  };
  void FindPlaces(const VoxelGrid& grid, Time first);
  // Counts what the scene says of the places of which something is known, for ahead_[i].
  void CountAt(std::size_t i, const SceneSnapshot& scene, const Eigen::Vector3d& sensor_W);

  Truth truth_;
  std::vector<Duration> ahead_;
  std::vector<Place> places_;  // found with the first version
  bool has_places_ = false;
  std::vector<Confusion> confusions_;
  std::map<ObjectId, std::vector<Confusion>> by_object_;
};

}  // namespace clearway
