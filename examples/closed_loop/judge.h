// What really happens to the robot.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "clearway/sim/world.h"
#include "closed_loop/robot.h"

namespace clearway::closed_loop {

// A first contact. A plain value.
struct Collision {
  ObjectId object = kStaticLabel;  // 0: what stands
  Time time;
  Eigen::Vector2d robot_W;
  // How long before it the object's first points were there; none: it was never seen.
  std::optional<Duration> seen_before = std::nullopt;

  // Whether there was a second to make way.
  bool InTime() const { return seen_before && *seen_before >= std::chrono::seconds(1); }
};

// Judges by the simulator's bodies alone: whoever is to blame, a contact is a collision. Each
// object counts once. One thread; the world must outlive it.
class Judge {
 public:
  Judge(const World& world, const Carrier& carrier);

  // The labels of the points of a scan.
  void Saw(std::span<const ObjectId> labels, Time time);
  // Where the robot truly is.
  void Look(const Eigen::Vector2d& robot_W, Time time);

  const std::vector<Collision>& collisions() const { return collisions_; }

 private:
  Carrier carrier_;
  std::vector<World> bodies_;  // one body each
  std::map<ObjectId, Time> first_seen_;
  std::set<ObjectId> touched_;
  std::vector<Collision> collisions_;
};

}  // namespace clearway::closed_loop
