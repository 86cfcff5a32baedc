#include "map/ray_rounds.h"

#include <cstdint>

namespace clearway {
namespace {

// Of thirteen rays in a row, the round of each; thirteen divides the width of hardly any camera.
constexpr std::array<std::uint8_t, 13> kRoundInARow{0, 2, 2, 2, 1, 2, 2, 2, 1, 2, 2, 1, 2};

}  // namespace

int MainAxis(const Eigen::Vector3f& direction) {
  const Eigen::Vector3f size = direction.cwiseAbs();
  if (size.x() >= size.y() && size.x() >= size.z()) return 0;
  return size.y() >= size.z() ? 1 : 2;
}

void RayRounds::Clear() {
  for (Round& round : rounds_) {
    round.rays.clear();
    round.lane = 0;
  }
  size_ = in_row_ = 0;
  box_.setEmpty();
}

void RayRounds::Add(const RaySegment& ray) {
  if (size_ == 0 || ray.origin != last_origin_) {
    one_origin_ = size_ == 0;
    last_origin_ = ray.origin;
    box_.extend(ray.origin);
  }
  box_.extend(ray.end);
  Round& round = rounds_[kRoundInARow[in_row_]];
  in_row_ = in_row_ + 1 == kRoundInARow.size() ? 0 : in_row_ + 1;
  ++size_;
  if (round.lane == 0) round.rays.push_back(EightOf({ray.origin, ray.origin}));
  Put(ray, round.lane, round.rays.back());
  round.lane = (round.lane + 1) % kRayLanes;
}

}  // namespace clearway
