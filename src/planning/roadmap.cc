#include "planning/roadmap.h"

#include <algorithm>
#include <cmath>

namespace clearway {

Roadmap::Roadmap(const SpaceTimeStateSpace& space) : space_(space) {}

Roadmap::~Roadmap() {
  for (const OnePlace& place : places_) space_.space()->freeState(place.part);
}

// By looking at all: the search takes far longer. Half as many as PRM* needs to be optimal in the
// limit (Karaman and Frazzoli, 2011): among much that moves, more and shorter ways serve better.
std::size_t Roadmap::Add(const ompl::base::State* part) {
  const std::size_t added = places_.size();
  std::vector<std::pair<double, std::size_t>> others;
  others.reserve(added);
  for (std::size_t i = 0; i < added; ++i) {
    others.emplace_back(space_.MinSeconds(part, places_[i].part), i);
  }
  const double dimension = space_.space()->getDimension();
  const double wanted = 0.5 * M_E * (1 + 1 / dimension) * std::log(static_cast<double>(added) + 2);
  const auto count = std::min(added, static_cast<std::size_t>(std::ceil(wanted)));
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count),
                    others.end());
  places_.push_back({space_.space()->cloneState(part), {}});
  for (std::size_t i = 0; i < count; ++i) Join(added, others[i].second);
  return added;
}

bool Roadmap::Joined(std::size_t a, std::size_t b) const {
  return std::ranges::find(places_[a].near, b, &Neighbor::place) != places_[a].near.end();
}

void Roadmap::Join(std::size_t a, std::size_t b) {
  if (a == b || Joined(a, b)) return;
  places_[a].near.push_back({b, Seconds(a, b)});
  places_[b].near.push_back({a, Seconds(b, a)});
}

}  // namespace clearway
