// Places, and which of them are near to each other.
#pragma once

#include <ompl/base/State.h>
#include <ompl/base/StateSampler.h>

#include <vector>

#include "clearway/planning/space_time.h"

namespace clearway {

// Random places of a space (without time), each with its nearest ones by the time to get there at
// full speed. Owns its states. One thread.
class Roadmap {
 public:
  explicit Roadmap(const SpaceTimeStateSpace& space);
  ~Roadmap();
  Roadmap(const Roadmap&) = delete;
  Roadmap& operator=(const Roadmap&) = delete;

  // Copies the place and joins it to its nearest ones, both ways.
  std::size_t Add(const ompl::base::State* part);
  // Joins two places, both ways, if they are not joined yet.
  void Join(std::size_t a, std::size_t b);

  // A place, and how long the way there takes.
  struct Neighbor {
    std::size_t place;
    double seconds;
  };

  std::size_t size() const { return places_.size(); }
  const ompl::base::State* Place(std::size_t place) const { return places_[place].part; }
  const std::vector<Neighbor>& Near(std::size_t place) const { return places_[place].near; }
  bool Joined(std::size_t a, std::size_t b) const;
  double Seconds(std::size_t from, std::size_t to) const {
    return space_.MinSeconds(places_[from].part, places_[to].part);
  }

 private:
  struct OnePlace {
    ompl::base::State* part;
    std::vector<Neighbor> near;
  };

  const SpaceTimeStateSpace& space_;
  std::vector<OnePlace> places_;
};

}  // namespace clearway
