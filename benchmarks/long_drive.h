// A drive as long as one likes.
#pragma once

#include <vector>

#include "clearway/scene/frame.h"

namespace clearway::bench {

// Whole scans along the simulator's street without its moving objects, one every 20 m; where the
// street ends it begins anew, shifted by its length, so that the map grows for ever. A value.
class LongDrive {
 public:
  LongDrive();
  Frame Next();
  // From the first scan to the last that Next gave.
  double driven_m() const { return driven_m_; }

 private:
  std::vector<Frame> street_;
  Eigen::Vector3d street_W_;  // from its first scan to where the first of the next street is
  std::size_t next_ = 0;
  double driven_m_ = 0;
};

}  // namespace clearway::bench
