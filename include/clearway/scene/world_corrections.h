// How the world that a source speaks of lies in the world of the scene.
#pragma once

#include <vector>

#include "clearway/base/time.h"
#include "clearway/scene/frame.h"

namespace clearway {

// The poses T_W_V of a source's world V in the scene's world W over time. They differ where the
// source's poses of the sensor are off and the scene mends them
// (SceneParams::sensor_pose_error_m): what the source states at t in V is at T_W_V(t) times that
// in W. A value.
class WorldCorrections {
 public:
  // Poses are forgotten that are older than the newest by more than `kept`.
  explicit WorldCorrections(Duration kept = std::chrono::seconds(10)) : kept_(kept) {}

  // Not before the newest; instead of that if it is of the same stamp.
  void Add(Time stamp, const Pose& T_W_V);

  // T_W_V at that time: of a frame of that stamp; between two, along the screw from one to the
  // other; else of the oldest or the newest. The identity if there are none.
  Pose At(Time t) const;

  // Whether there are none. Newest: there must be one.
  bool Empty() const { return poses_.empty(); }
  Time NewestStamp() const { return poses_.back().stamp; }

 private:
  struct Stamped {
    Time stamp;
    Pose T_W_V;
  };
  Duration kept_;
  std::vector<Stamped> poses_;  // ascending stamps
};

// T_W_X of what the source says is at T_V_X at that time; T_V_X itself, bit for bit, where the
// worlds are the same.
Pose Carried(const WorldCorrections& corrections, Time t, const Pose& T_V_X);

// The frame of V in W: its poses as they are at its stamp, and motions from the world as it was
// corrected when they start.
Frame CarriedBy(const WorldCorrections& corrections, Frame frame_V);

}  // namespace clearway
