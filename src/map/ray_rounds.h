// The order in which the rays of a scan are walked.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "map/ray_lanes.h"

namespace clearway {

// The axis of the largest component.
int MainAxis(const Eigen::Vector3f& direction);

// Rays in the grid's frame, all with the same main axis and the same sign along it, dealt to the
// rounds in which they are walked: a few that lie apart, some more, then the rest, of which the
// first steps are skipped where the rounds before have marked all there is to mark. Keeps its
// memory when cleared.
class RayRounds {
 public:
  static constexpr std::size_t kCount = 3;

  void Clear();
  void Add(const RaySegment& ray);

  std::size_t size() const { return size_; }
  // The last eight may be filled up with rays that go nowhere.
  const std::vector<RaySegments>& round(std::size_t i) const { return rounds_[i].rays; }
  // Whether all rays begin at one point.
  bool one_origin() const { return one_origin_; }
  // Around the rays.
  const Eigen::AlignedBox3f& box() const { return box_; }

 private:
  struct Round {
    std::vector<RaySegments> rays;
    int lane = 0;  // the next to be filled; 0: of a new eight
  };

  std::array<Round, kCount> rounds_;
  std::size_t size_ = 0;
  std::size_t in_row_ = 0;  // the next one's place
  Eigen::Vector3f last_origin_;
  bool one_origin_ = true;
  Eigen::AlignedBox3f box_;
};

}  // namespace clearway
