// Which stamps a scene accepts.
#pragma once

#include <map>
#include <string>

#include "absl/status/status.h"
#include "clearway/base/time.h"
#include "clearway/scene/scene_builder.h"

namespace clearway {

// The newest stamp of each sensor.
using SensorStamps = std::map<std::string, Time>;

// FAILED_PRECONDITION for a stamp before the newest of the same sensor, for one that is late by
// more than the window, and for one too far ahead of `newest`, the scene's newest frame.
absl::Status CheckStamp(const Frame& frame, Time newest, const SensorStamps& sensors,
                        const FrameLimits& limits, const ApplyOptions& options);

// With the frame's stamp, without those too old to matter to any frame that CheckStamp accepts.
// Bounded: of more than kMaxSensorStamps sensors the oldest are forgotten, whose stamps may then go
// back within the window.
inline constexpr std::size_t kMaxSensorStamps = 1024;
SensorStamps WithStampOf(const Frame& frame, Time newest, SensorStamps sensors,
                         const FrameLimits& limits);

}  // namespace clearway
