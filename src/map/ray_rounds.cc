#include "map/ray_rounds.h"

#include <algorithm>
#include <span>

namespace clearway {
namespace {

// Of rays in a row, the places of those of each round.
constexpr std::array<std::size_t, 1> kFirst{0};
constexpr std::array<std::size_t, 3> kSecond{4, 8, 11};
constexpr std::array<std::size_t, 9> kRest{1, 2, 3, 5, 6, 7, 9, 10, 12};
static_assert(kFirst.size() + kSecond.size() + kRest.size() == RayRounds::kInARow);

// The rays at these places of each row, in order.
template <std::size_t kPlaces>
void DealTo(std::vector<RaySegments>& round, const std::array<std::size_t, kPlaces>& places,
            std::span<const RaySegment> rows) {
  for (std::size_t eight = 0; eight < kPlaces; ++eight) {
    RaySegments& rays = round.emplace_back();
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = eight * kLanes + lane;
      Put(rows[i / kPlaces * RayRounds::kInARow + places[i % kPlaces]], lane, rays);
    }
  }
}

}  // namespace

void RayRounds::Clear() {
  for (auto& round : rounds_) round.clear();
  size_ = 0;
}

void RayRounds::Finish() {
  const std::size_t last = size_ % kDealtTogether;
  if (last == 0) return;
  const Eigen::Vector3f origin = waiting_[0].origin;
  std::fill(waiting_.begin() + last, waiting_.end(), RaySegment{origin, origin});
  Deal();
}

void RayRounds::Deal() {
  DealTo(rounds_[0], kFirst, waiting_);
  DealTo(rounds_[1], kSecond, waiting_);
  DealTo(rounds_[2], kRest, waiting_);
}

RayBoxes RayRounds::BoxesAround() const {
  RayBoxes boxes;
  for (const auto& round : rounds_) boxes.Extend(clearway::BoxesAround(round));
  return boxes;
}

}  // namespace clearway
