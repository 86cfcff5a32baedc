// Numbers and values for people.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "clearway/base/time.h"

namespace clearway::cli {

std::string Fixed(double value, int decimals);
// The same; "-" for NaN.
std::string FixedOrDash(double value, int decimals);
// "1,234,567".
std::string Grouped(std::uint64_t count);
// "987", "12.3 k", "2.81 M".
std::string Scaled(double value);
// "34.1 MB".
std::string Bytes(std::uint64_t bytes);
// Seconds of sensor time: "12.5 s", nanoseconds kept if there are any.
std::string Seconds(Time time);
std::string Seconds(Duration duration);
// Time of a clock: "0:07", "1:02:03".
std::string Clock(double seconds);
// "(1.00, 2.00, 3.00)", metres.
std::string Point(const Eigen::Vector3d& p, int decimals = 2);
// "4.31 x 1.80 x 1.62 m"; "-" if there is nothing.
std::string Size(const Eigen::Vector3d& size);
// "1 frame", "2 frames".
std::string Plural(std::uint64_t count, const std::string& noun);
// One word of a POSIX shell: "x.json", "'my file'".
std::string ShellQuoted(const std::string& word);

}  // namespace clearway::cli
