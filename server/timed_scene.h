// Points at times of their own.
#pragma once

#include <cstdint>
#include <vector>

#include "absl/container/flat_hash_map.h"
#include "clearway/scene/occupancy.h"

namespace clearway {

// The occupancy of points at many times on one version: what SceneAtTime says, without placing
// every object at every time. One thread. It must not outlive the snapshot.
class TimedScene {
 public:
  explicit TimedScene(const SceneSnapshot& scene);

  PointOccupancy At(const Eigen::Vector3d& p_W, Time time);
  // Every object placed at the time. Valid until the next call.
  const SceneAtTime& Placed(Time time);

 private:
  // An object and all that it may have reached lie within radius_m + speed_mps * (t - t_k) of
  // center_W, at any t from t_k on: in a screw the origin's speed is constant.
  struct Reach {
    Eigen::Vector3d center_W;
    double radius_m;
    double speed_mps;
    Time t_k;
  };
  static Reach ReachOf(const MovingObject& object);
  bool MayMeetAnObject(const Eigen::Vector3d& p_W, Time time) const;

  const SceneSnapshot& scene_;
  SceneSnapshot without_objects_;
  SceneAtTime static_map_;
  std::vector<Reach> reaches_;
  absl::flat_hash_map<std::int64_t, SceneAtTime> placed_;  // by the time in ns; the last ones asked
};

}  // namespace clearway
