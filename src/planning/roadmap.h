// Places, and which of them are near to each other.
#pragma once

#include <ompl/base/State.h>
#include <ompl/datastructures/NearestNeighborsGNATNoThreadSafety.h>

#include <vector>

#include "clearway/planning/space_time.h"

namespace clearway {

// Random places of a space (without time), each with its nearest ones by the time to get there at
// full speed, which are looked for when they are asked for. Owns its states. One thread.
class Roadmap {
 public:
  explicit Roadmap(const SpaceTimeStateSpace& space);
  ~Roadmap();
  Roadmap(const Roadmap&) = delete;
  Roadmap& operator=(const Roadmap&) = delete;

  // Copies the place.
  std::size_t Add(const ompl::base::State* part);
  // Makes the two each other's neighbours, however far they are.
  void Join(std::size_t a, std::size_t b);

  // A place, and how long the way there takes.
  struct Neighbor {
    std::size_t place;
    double seconds;
  };

  std::size_t size() const { return places_.size(); }
  const ompl::base::State* Place(std::size_t place) const { return places_[place].part; }
  // Its nearest ones, by what it takes to go there, and those joined to it. Valid until the roadmap
  // changes.
  const std::vector<Neighbor>& Near(std::size_t place);
  double Seconds(std::size_t from, std::size_t to) const {
    return space_.MinSeconds(places_[from].part, places_[to].part);
  }

 private:
  struct OnePlace {
    ompl::base::State* part;
    std::vector<Neighbor> joined;
    std::size_t looked_at = 0;   // how many places there were when `near` was found
    std::vector<Neighbor> near;  // with those joined
  };
  std::size_t NearestCount() const;

  const SpaceTimeStateSpace& space_;
  std::vector<OnePlace> places_;
  ompl::NearestNeighborsGNATNoThreadSafety<std::size_t> nearest_;  // all places
  std::vector<std::size_t> found_;                                 // of Near
};

}  // namespace clearway
