// Sensor time. No function of Clearway reads the wall clock: a time is always what a sensor
// stamped.
#pragma once

#include <chrono>
#include <cstdint>

namespace clearway {

// Nanoseconds; every duration in a public signature is of this type.
using Duration = std::chrono::nanoseconds;

// The clock of the sensors. It has no now(): times come from input only.
struct SensorClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SensorClock, Duration>;
  static constexpr bool is_steady = true;
};

// An instant in nanoseconds of sensor time.
using Time = SensorClock::time_point;

constexpr Time TimeFromNanoseconds(std::int64_t ns) { return Time(Duration(ns)); }
constexpr std::int64_t ToNanoseconds(Time time) { return time.time_since_epoch().count(); }

// No time further than this from 0 is accepted (146 years): the difference of two never overflows.
constexpr std::int64_t kFarthest_ns = (std::int64_t{1} << 62) - 1;

constexpr double ToSeconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

// Rounds to the nearest nanosecond. `seconds` must be finite and below 2^63 ns (292 years).
constexpr Duration FromSeconds(double seconds) {
  return Duration(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
}

}  // namespace clearway
