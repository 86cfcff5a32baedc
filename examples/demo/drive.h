// A crossing that is driven while frames keep coming.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "closed_loop/navigator.h"
#include "demo/case.h"

namespace clearway::demo {

// Motions of objects are told over so long: boxes jitter, and velocities over a frame with them.
inline constexpr Duration kDriveMotionsOver = std::chrono::seconds(1);

// A robot that starts at a place and looks at every version of the scene: whether its way is still
// good, and on every fifth one whether there is a better one. What it decides takes effect a tenth
// of a second later. One thread.
class Drive {
 public:
  // Starts at rest at the crossing's `now`. The case must have a place.
  Drive(PosedCase posed, const PlanSettings& settings);

  // Goes on to `scene->stamp`, with what was decided before, and decides if it is time.
  void Step(ScenePtr scene);
  CaseResult Result(const Truth& truth) const;

 private:
  bool Arrived() const;
  // Whether it has arrived or its time is up.
  bool Over() const;
  // Goes on with what was decided last.
  void GoOnTo(Time time);
  void Append(Time time);

  PosedCase posed_;
  closed_loop::Errand errand_;
  closed_loop::Navigator navigator_;
  closed_loop::TimedPath path_;
  std::optional<closed_loop::Decision> decided_;  // not in effect yet
  std::vector<TimedPose> driven_;
  DriveLog log_;
};

}  // namespace clearway::demo
