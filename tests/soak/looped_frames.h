// Frames without end over the same ground.
#pragma once

#include <cstddef>
#include <vector>

#include "clearway/scene/frame.h"

namespace clearway::soak {

// Repeats frames again and again. Time goes on, and the objects of each round have ids of their
// own, so that those of the round before are dropped after their lifetime. One thread.
class LoopedFrames {
 public:
  // At least one frame, at most one object id in 2,000,000; `gap` lies between two rounds.
  LoopedFrames(std::vector<Frame> frames, Duration gap);

  Frame Next();

 private:
  const std::vector<Frame> frames_;
  Duration round_;          // from one round's first frame to the next one's
  ObjectId ids_per_round_;  // the next round's begin above them
  std::size_t next_ = 0;
  int rounds_ = 0;
};

// An object on a circle above a place that is seen by a sensor of its own. Motions come with its
// first frames alone; then it has points without motion for ever.
class BridgedObject {
 public:
  static constexpr ObjectId kId = 1;

  explicit BridgedObject(const Eigen::Vector3d& center_W) : center_W_(center_W) {}

  Frame At(Time stamp);

 private:
  Pose T_W_O(Time stamp) const;

  const Eigen::Vector3d center_W_;
  int frames_ = 0;
  Time begin_, last_;
};

}  // namespace clearway::soak
