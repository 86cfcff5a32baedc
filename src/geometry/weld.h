// Vertices at the same place.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace clearway {

// For each point the first one that is where it is.
std::vector<std::uint32_t> WeldEqual(const std::vector<Eigen::Vector3d>& points);

// For each point a point within the tolerance that stands for it: itself, or an earlier one that
// stands for itself. Points in neighbouring cells of a grid are compared, so that a few of many
// points in one cell may stay apart.
std::vector<std::uint32_t> WeldNear(const std::vector<Eigen::Vector3d>& points, double tolerance_m);

}  // namespace clearway
