// What rotations from outside may look like.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clearway/geometry/pose.h"

namespace clearway {

// Every input's limit on the distance of a quaternion's length from 1: components printed with two
// decimals pass. Whatever passes is normalised before it is used.
inline constexpr double kUnitTolerance = 0.01;

// False for NaN.
bool IsNearlyUnit(const Eigen::Quaterniond& q);

// "has length 1.5; a unit quaternion is needed, to within 0.01".
std::string NotUnitText(const Eigen::Quaterniond& q);

// Of length 1. Unchanged, bit for bit, if rounding alone keeps it from that: poses that were
// computed stay as they are.
Eigen::Quaterniond Normalized(const Eigen::Quaterniond& q);
Pose Normalized(const Pose& pose);
// All of them, if that changes any.
std::optional<std::vector<Pose>> Renormalized(std::span<const Pose> poses);

}  // namespace clearway
