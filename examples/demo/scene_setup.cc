#include "demo/scene_setup.h"

#include "absl/strings/str_cat.h"
#include "clearway/scene/scene_builder.h"

namespace clearway::demo {
namespace {

constexpr Duration kHorizon = std::chrono::seconds(12);  // as long as a crossing takes
// Who drives meets objects that have not been seen for a while, and is not to mind them for ever.
constexpr Duration kDriveHorizon = std::chrono::seconds(30);
constexpr Duration kDriveLifetime = std::chrono::seconds(5);
// In a second. Recorded boxes of parked vehicles jitter; on the KITTI drive 0.4 is too little.
constexpr double kRestDistanceM = 0.6;
constexpr double kMaxRangeM = 50;  // beyond, the beams of a LiDAR lie too far apart

}  // namespace

SceneParams ParamsFor(const Sequence& sequence, bool drive) {
  SceneParams params;
  params.resolution_m = params.object_resolution_m = sequence.frames.resolution_m;
  params.rays.max_range_m = kMaxRangeM;
  params.rest_distance_m = kRestDistanceM;
  params.horizon = drive ? kDriveHorizon : kHorizon;
  if (drive) params.object_lifetime = kDriveLifetime;
  return params;
}

std::vector<std::string> ServerFlags(const SceneParams& params) {
  return {"--log-level=warning",
          absl::StrCat("--scene-resolution-m=", params.resolution_m),
          absl::StrCat("--scene-object-resolution-m=", params.object_resolution_m),
          absl::StrCat("--scene-horizon-s=", ToSeconds(params.horizon)),
          absl::StrCat("--scene-object-lifetime-s=", ToSeconds(params.object_lifetime)),
          absl::StrCat("--scene-rest-distance-m=", params.rest_distance_m),
          absl::StrCat("--scene-max-range-m=", params.rays.max_range_m)};
}

absl::StatusOr<ScenePtr> SceneAtTheEnd(const Sequence& sequence, const SceneParams& params) {
  ThreadPool pool(1);
  SceneBuilder builder(params, FrameLimits(), pool);
  for (std::size_t i = 0; i < sequence.frames.frame_count; ++i) {
    const auto frame = sequence.frames.read(i);
    if (!frame.ok()) return frame.status();
    if (const auto report = builder.Apply(*frame); !report.ok()) return report.status();
  }
  return builder.Publish();
}

}  // namespace clearway::demo
