#include "closed_loop/judge.h"

namespace clearway::closed_loop {

Judge::Judge(const World& world, const Carrier& carrier) : carrier_(carrier) {
  for (const Body& body : world.bodies()) bodies_.emplace_back(std::vector<Body>{body});
}

void Judge::Saw(std::span<const ObjectId> labels, Time time) {
  for (const ObjectId label : labels) first_seen_.try_emplace(label, time);
}

void Judge::Look(const Eigen::Vector2d& robot_W, Time time) {
  for (const World& body : bodies_) {
    const ObjectId id = body.bodies()[0].id;
    if (touched_.contains(id) || !body.Touched(carrier_.body, carrier_.LinkPose(robot_W), time))
      continue;
    touched_.insert(id);
    Collision& collision = collisions_.emplace_back(Collision{id, time, robot_W});
    if (const auto seen = first_seen_.find(id); seen != first_seen_.end()) {
      collision.seen_before = time - seen->second;
    }
  }
}

}  // namespace clearway::closed_loop
