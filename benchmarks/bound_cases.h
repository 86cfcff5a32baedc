// Predictions of recorded objects with what their bounds follow from.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "scene/position_bound.h"
#include "scene/prospect.h"

namespace clearway::bench {

inline constexpr std::array kBoundAhead = {
    std::chrono::milliseconds(500), std::chrono::milliseconds(1000),
    std::chrono::milliseconds(2000), std::chrono::milliseconds(3000)};
inline constexpr std::size_t kBoundAheadCount = kBoundAhead.size();

// How the scene predicts; what the recordings are run with.
struct BoundSetting {
  std::string name;
  SceneParams params;
};
// Each motion model, with the rest distance of the demo and without one.
std::vector<BoundSetting> BoundSettings();

// The predictions of one object from one of its poses.
struct BoundCase {
  std::size_t setting = 0;  // of BoundSettings
  std::string object_class;
  double age_s = 0;  // how long it has been tracked
  double speed_mps = 0;
  Evidence evidence;
  // NaN where it is not known where the object was.
  std::array<double, kBoundAheadCount> errors_m;

  bool IsFirstSight() const { return !evidence.has_motion && evidence.velocity_O == Twist{}; }
  bool AtRest() const { return evidence.has_motion && evidence.velocity_O == Twist{}; }
};

struct BoundRecording {
  std::string name;
  // Recordings of one group show the same scene, and are left out together.
  std::string group;
  bool simulated = false;
  std::vector<BoundCase> cases;
};

// All recordings that are there: KITTI, Argoverse 2, UCY, NGSIM (CommonRoad); and simulated worlds.
// An error names the file that cannot be read. Takes about two minutes.
absl::StatusOr<std::vector<BoundRecording>> ReadBoundRecordings();

}  // namespace clearway::bench
