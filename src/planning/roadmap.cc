#include "planning/roadmap.h"

#include <algorithm>
#include <cmath>

namespace clearway {
namespace {

bool Holds(const std::vector<Roadmap::Neighbor>& neighbors, std::size_t place) {
  return std::ranges::find(neighbors, place, &Roadmap::Neighbor::place) != neighbors.end();
}

}  // namespace

Roadmap::Roadmap(const SpaceTimeStateSpace& space) : space_(space) {
  nearest_.setDistanceFunction([this](std::size_t a, std::size_t b) { return Seconds(a, b); });
}

Roadmap::~Roadmap() {
  for (const OnePlace& place : places_) space_.space()->freeState(place.part);
}

std::size_t Roadmap::Add(const ompl::base::State* part) {
  places_.push_back({space_.space()->cloneState(part), {}, 0, {}});
  nearest_.add(places_.size() - 1);
  return places_.size() - 1;
}

// As many as PRM* needs to be optimal in the limit (Karaman and Frazzoli, 2011).
std::size_t Roadmap::NearestCount() const {
  const double dimension = space_.space()->getDimension();
  const auto all = static_cast<double>(places_.size());
  return static_cast<std::size_t>(std::ceil(M_E * (1 + 1 / dimension) * std::log(all + 1)));
}

const std::vector<Roadmap::Neighbor>& Roadmap::Near(std::size_t place) {
  OnePlace& here = places_[place];
  if (here.looked_at == places_.size()) return here.near;
  here.looked_at = places_.size();
  nearest_.nearestK(place, NearestCount() + 1, found_);  // with the place itself
  here.near.clear();
  for (const std::size_t other : found_) {
    if (other != place) here.near.push_back({other, Seconds(place, other)});
  }
  for (const Neighbor& to : here.joined) {
    if (!Holds(here.near, to.place)) here.near.push_back(to);
  }
  return here.near;
}

void Roadmap::Join(std::size_t a, std::size_t b) {
  if (a == b || Holds(places_[a].joined, b)) return;
  places_[a].joined.push_back({b, Seconds(a, b)});
  places_[b].joined.push_back({a, Seconds(b, a)});
  places_[a].looked_at = places_[b].looked_at = 0;
}

}  // namespace clearway
