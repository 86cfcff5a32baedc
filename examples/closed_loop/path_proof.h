// Until when paths are free, by proof.
#pragma once

#include <vector>

#include "clearway/collision/state_checker.h"
#include "closed_loop/robot.h"

namespace clearway::closed_loop {

// For each path, which is followed from `from` on and held at its end: up to when, at most `until`,
// it is proved free; `from` if that is in contact or cannot be told.
std::vector<Time> FreeUntil(const StateChecker& checker, const Carrier& carrier,
                            const std::vector<TimedPath>& paths, Time from, Time until,
                            const CheckOptions& options);

}  // namespace clearway::closed_loop
