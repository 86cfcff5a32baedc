// Texts of flags, as values.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "clearway/base/time.h"
#include "clearway/geometry/aabb.h"

namespace clearway::cli {

// A time as it was asked for: absolute, or relative to the newest stamp of the scene.
struct TimeArgument {
  bool relative = true;
  Duration offset{0};  // since the epoch of sensor time, or since the newest stamp

  Time At(Time newest) const { return relative ? newest + offset : Time(offset); }
  bool operator==(const TimeArgument&) const = default;
};

// INVALID_ARGUMENT, saying what was expected and found.
//
// "12.5" (seconds of sensor time, nine decimals exactly), "+1.5", "now", "now-2".
absl::StatusOr<TimeArgument> ParseTime(const std::string& text);
// Seconds without a sign or with one, to the nanosecond.
absl::StatusOr<Duration> ParseSeconds(const std::string& text);
absl::StatusOr<double> ParseFinite(const std::string& text);
// Numbers with commas between them; fields may have blanks around them.
absl::StatusOr<std::vector<double>> ParseNumbers(const std::string& text);
// "x,y,z".
absl::StatusOr<Eigen::Vector3d> ParsePoint(const std::string& text);
// "x0,y0,z0,x1,y1,z1": two opposite corners.
absl::StatusOr<Aabb> ParseBox(const std::string& text);
// The same, but the lowest corner must come first: a swapped pair is refused, not put right.
absl::StatusOr<Aabb> ParseOrderedBox(const std::string& text);
// The same of boxes that have a volume.
absl::StatusOr<Aabb> ParseSolidBox(const std::string& text);
// "x0,y0,x1,y1": two opposite corners; z stays 0.
absl::StatusOr<Aabb> ParseArea(const std::string& text);

}  // namespace clearway::cli
