#include "planning/roadmap.h"

#include <algorithm>
#include <cmath>

namespace clearway {
namespace {

bool Holds(const std::vector<Roadmap::Neighbor>& neighbors, std::size_t place) {
  return std::ranges::find(neighbors, place, &Roadmap::Neighbor::place) != neighbors.end();
}

}  // namespace

Roadmap::Roadmap(const SpaceTimeStateSpace& space) : space_(space) {}

Roadmap::~Roadmap() {
  for (const OnePlace& place : places_) space_.space()->freeState(place.part);
}

std::size_t Roadmap::Add(const ompl::base::State* part) {
  places_.push_back({space_.space()->cloneState(part), {}, {}, 0, {}});
  return places_.size() - 1;
}

// As many as PRM* needs to be optimal in the limit (Karaman and Frazzoli, 2011).
std::size_t Roadmap::NearestCount() const {
  const double dimension = space_.space()->getDimension();
  const auto all = static_cast<double>(places_.size());
  return static_cast<std::size_t>(std::ceil(M_E * (1 + 1 / dimension) * std::log(all + 1)));
}

// By looking at all that came since: the search takes far longer.
const std::vector<Roadmap::Neighbor>& Roadmap::Near(std::size_t place) {
  OnePlace& here = places_[place];
  if (here.looked_at == places_.size()) return here.near;
  for (std::size_t i = here.looked_at; i < places_.size(); ++i) {
    if (i != place) here.nearest.push_back({i, Seconds(place, i)});
  }
  here.looked_at = places_.size();
  const std::size_t count = std::min(here.nearest.size(), NearestCount());
  std::ranges::partial_sort(here.nearest, here.nearest.begin() + static_cast<std::ptrdiff_t>(count),
                            {}, &Neighbor::seconds);
  here.nearest.resize(count);
  here.near = here.nearest;
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
  places_[a].nearest.clear();
  places_[b].nearest.clear();
}

}  // namespace clearway
