// How objects are predicted once the source falls silent about them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "clearway/scene/frame.h"
#include "clearway/scene/scene_params.h"

namespace clearway::bench {

// Frames that report motions, and where each object truly is.
struct ReportedDrive {
  std::vector<Frame> frames;
  std::function<std::optional<Pose>(ObjectId id, std::size_t frame)> T_W_B;
  double resolution_m = 0.1;
};

// Of predictions a second ahead, from 0.8 s after the reports ended up to 3 s after. Without
// objects whose model began anew meanwhile.
struct EndedReports {
  int predictions = 0;
  double miss_m = 0;    // median over the objects
  double bound_m = 0;   // likewise, of the 95 % bound
  double held = 0;      // the share of predictions that were within it
  double in_solid = 0;  // of true centres that lay in the box of the predicted solid
  int begun_anew = 0;
};

// Reports end after frame 15, 35, and so on, in a scene of its own each.
EndedReports AfterReportsEnd(const ReportedDrive& drive, MotionFromPoints from_points);

}  // namespace clearway::bench
