// Worlds for a robot to cross, made of a seed.
#pragma once

#include <cstdint>

#include "clearway/sim/world.h"
#include "closed_loop/robot.h"

namespace clearway::closed_loop {

enum class Traffic {
  kSteady,   // each object keeps its motion and leaves
  kTurning,  // objects turn, stop and start again at any time
};

// Something to cross: walls and pillars on a flat place, with carts and people who cross between
// start and goal and do not look out for the robot. A plain value.
struct Course {
  World world;  // from time 0 on
  Errand errand;
};

// The same seed makes the same course. No object is near the start in the first seconds, none
// passes through another or through a wall, and each leaves room for the robot between itself and
// whatever stands.
Course MakeCourse(std::uint64_t seed, Traffic traffic);

}  // namespace clearway::closed_loop
