// Polygons cut into triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "absl/status/status.h"

namespace clearway {

// Clips ears (Meisters, "Polygons have ears", 1975) off a polygon in space, as it is seen along its
// normal, so that concave polygons are cut right; its corners need not lie in one plane. Keeps its
// memory from one polygon to the next. One thread.
class PolygonCutter {
 public:
  static constexpr std::size_t kMaxCorners = 10'000;
  // Of all polygons that are not convex: the work grows with the square of their corners.
  static constexpr std::uint64_t kMaxCornerPairs = 1'000'000'000;

  // Cuts the polygon with these corners, which are finite. INVALID_ARGUMENT if it crosses or
  // touches itself, has more corners than kMaxCorners, or is so large that its area is not finite;
  // RESOURCE_EXHAUSTED above kMaxCornerPairs. Slivers may cross themselves, as rounding makes some.
  absl::Status Cut(const std::vector<Eigen::Vector3d>& corners);

  // The corners of each triangle, in the order in which the polygon has them.
  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }

 private:
  void DropRepeatedCorners(const std::vector<Eigen::Vector3d>& corners);
  Eigen::Vector3d Normal(const std::vector<Eigen::Vector3d>& corners) const;
  void Project(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& normal);
  bool IsSliver(const std::vector<Eigen::Vector3d>& corners) const;
  bool IsConvex() const;
  bool IsSimple() const;
  void Link();
  bool ClipEars();
  double TurnAt(std::size_t i) const;
  bool IsEar(std::size_t i) const;
  void Clip(std::size_t i);
  void AddTriangle(std::size_t a, std::size_t b, std::size_t c);
  void Fan();

  std::vector<std::uint32_t> ring_;      // corners without repetitions
  std::vector<Eigen::Vector2d> points_;  // of the ring, counter-clockwise
  // Of what is left of the ring: the neighbours of each point, whether its triangle with them is an
  // ear, and the points that are not convex.
  std::vector<std::size_t> previous_, next_, blockers_;
  std::vector<char> is_ear_;
  std::uint64_t corner_pairs_ = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace clearway
