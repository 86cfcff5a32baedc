// Converters of check_service.proto for intervals of time.
#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/collision/departure_intervals.h"
#include "clearway/collision/safe_intervals.h"
#include "clearway/v1/check_service.pb.h"
#include "clearway/wire/server_info.h"

namespace clearway {

// What FindSafeIntervals is asked, beside the scene and the robot.
struct SafeIntervalQuestion {
  std::vector<Pose> T_W_L;
  TimeInterval window;
  SafeIntervalOptions options;
};
void Write(std::span<const Pose> T_W_L, const TimeInterval& window,
           const SafeIntervalOptions& options, v1::FindSafeIntervalsRequest* proto);
// RESOURCE_EXHAUSTED for more configurations than states may be. Whether the options and the window
// make sense is for FindSafeIntervals.
absl::StatusOr<SafeIntervalQuestion> ReadSafeIntervalQuestion(
    const v1::FindSafeIntervalsRequest& proto, std::size_t links, const ServerLimits& limits);

// All but the motions.
void Write(const TimeInterval& window, const DepartureIntervalOptions& options,
           v1::FindDepartureIntervalsRequest* proto);
absl::StatusOr<TimeInterval> ReadDepartureWindow(const v1::FindDepartureIntervalsRequest& proto);
Duration ReadResolution(const v1::FindDepartureIntervalsRequest& proto);

void Write(const std::vector<std::vector<TimeInterval>>& intervals, v1::TimeIntervals* proto);
// INTERNAL if they are not those of so many items.
absl::StatusOr<std::vector<std::vector<TimeInterval>>> ReadTimeIntervals(
    const v1::TimeIntervals& proto, std::size_t items);

}  // namespace clearway
