// The order in which the rays of a scan are walked.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "map/ray_boxes.h"

namespace clearway {

// The axis of the largest component.
inline int MainAxis(const Eigen::Vector3f& direction) {
  const float x = std::abs(direction.x()), y = std::abs(direction.y()), z = std::abs(direction.z());
  const int of_x_and_y = x >= y ? 0 : 1;
  return z > std::max(x, y) ? 2 : of_x_and_y;
}

// Rays in the grid's frame, dealt to the rounds in which they are walked: a few that lie apart,
// some more, then the rest, of which the first steps are skipped where the rounds before have
// marked all there is to mark. Keeps its memory when cleared.
class RayRounds {
 public:
  static constexpr std::size_t kCount = 3;
  // Rays in a row, of which each round has its share. Hardly any camera's width is a multiple.
  static constexpr std::size_t kInARow = 13;

  void Clear();
  void Add(const RaySegment& ray) {
    waiting_[size_ % kDealtTogether] = ray;
    if (++size_ % kDealtTogether == 0) Deal();
  }
  // Once, after the last ray.
  void Finish();

  std::size_t size() const { return size_; }
  // Once finished. Some may be rays that go nowhere.
  const std::vector<RaySegments>& round(std::size_t i) const { return rounds_[i]; }
  // Calls visit(RaySegment) for each of them, round by round.
  template <class Visit>
  void ForEach(Visit&& visit) const {
    for (const auto& round : rounds_) {
      for (const RaySegments& eight : round) {
        for (int lane = 0; lane < kLanes; ++lane) visit(SegmentIn(eight, lane));
      }
    }
  }
  RayBoxes BoxesAround() const;

 private:
  static constexpr std::size_t kDealtTogether = kInARow * kLanes;  // whole eights to each round

  void Deal();

  std::array<RaySegment, kDealtTogether> waiting_;
  std::array<std::vector<RaySegments>, kCount> rounds_;
  std::size_t size_ = 0;
};

}  // namespace clearway
