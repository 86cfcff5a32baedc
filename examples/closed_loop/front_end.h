// What the robot's Dynamic SLAM front end says of its scans.
#pragma once

#include <map>
#include <vector>

#include "clearway/sim/simulation.h"

namespace clearway::closed_loop {

// Makes the frames of a sensor that goes where the loop takes it, with motions of what it sees and
// has seen before. One thread.
class FrontEnd {
 public:
  // Motions are told over up to `motion_over`, from a scan in which the object was seen to the one
  // at hand: errors of single poses count the less in a velocity the longer that is, and a turn is
  // noticed the later.
  FrontEnd(Simulation simulation, Duration motion_over);

  // The scan from where the sensor truly is. Frames are made one by one, k ascending.
  Frame Scan(const Pose& T_W_S, std::size_t k);

 private:
  ObjectMotion MotionTo(std::size_t k, ObjectId id, const std::vector<std::size_t>& seen) const;

  Simulation simulation_;
  Duration motion_over_;
  std::map<ObjectId, std::vector<std::size_t>> seen_;  // in which frames, ascending
};

}  // namespace clearway::closed_loop
