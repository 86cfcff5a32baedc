#include "scene/frame_stamps.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace clearway {
namespace {

// Nine decimals: two stamps that differ never read the same.
std::string Seconds(Duration duration) {
  const std::int64_t ns = duration.count();
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  return absl::StrFormat("%d.%09d s", ns / kNanoseconds, ns % kNanoseconds);
}

absl::Status Refused(const Frame& frame, const std::string& what) {
  return absl::FailedPreconditionError(absl::StrCat("stamp_ns: ", ToNanoseconds(frame.stamp),
                                                    " of sensor \"", frame.sensor_id, "\" ", what));
}

}  // namespace

absl::Status CheckStamp(const Frame& frame, Time newest, const SensorStamps& sensors,
                        const FrameLimits& limits, const ApplyOptions& options) {
  if (frame.stamp > newest) {
    const Duration ahead = frame.stamp - newest;
    if (ahead <= limits.max_stamp_jump || options.allow_stamp_jump) return absl::OkStatus();
    return Refused(frame, absl::StrCat("lies ", Seconds(ahead), " after the scene's newest frame, ",
                                       ToNanoseconds(newest), "; the limit is ",
                                       Seconds(limits.max_stamp_jump),
                                       " (max_stamp_jump_s); allow_stamp_jump accepts it"));
  }
  const auto own = sensors.find(frame.sensor_id);
  if (own != sensors.end() && frame.stamp < own->second) {
    return Refused(frame, absl::StrCat("lies ", Seconds(own->second - frame.stamp),
                                       " before the newest frame of the same sensor, ",
                                       ToNanoseconds(own->second),
                                       "; a source that starts over needs a reset of the scene"));
  }
  const Duration late_by = newest - frame.stamp;
  if (late_by <= limits.late_window) return absl::OkStatus();
  return Refused(frame,
                 absl::StrCat("lies ", Seconds(late_by), " before the scene's newest frame, ",
                              ToNanoseconds(newest), "; frames may be late by at most ",
                              Seconds(limits.late_window), " (late_window_s)"));
}

SensorStamps WithStampOf(const Frame& frame, Time newest, SensorStamps sensors,
                         const FrameLimits& limits) {
  sensors[frame.sensor_id] = frame.stamp;
  std::erase_if(sensors,
                [&](const auto& entry) { return newest - entry.second > limits.late_window; });
  if (sensors.size() > kMaxSensorStamps) {
    sensors.erase(
        std::ranges::min_element(sensors, {}, [](const auto& entry) { return entry.second; }));
  }
  return sensors;
}

}  // namespace clearway
