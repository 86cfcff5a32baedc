// Where to go if there is no way to the goal.
#pragma once

#include "clearway/collision/state_checker.h"
#include "closed_loop/robot.h"

namespace clearway::closed_loop {

// A plain value.
struct Evasion {
  TimedPath path;
  Time free_until;  // by proof
};

// Standing still, and straight ways of several lengths in all directions at full speed to stand
// still at their ends: the one that is proved free the longest, up to `until`; of several, the one
// that ends nearest to the goal. Ends lie in the errand's area.
Evasion FindEvasion(const StateChecker& checker, const TimedPath::Knot& start, const Errand& errand,
                    Time until, const CheckOptions& options);

}  // namespace clearway::closed_loop
