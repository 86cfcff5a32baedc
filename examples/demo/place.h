// Where a problem is posed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "clearway/client/connection.h"
#include "demo/plan.h"
#include "demo/sequence.h"

namespace clearway::demo {

// A place that poses a problem: the straight way at full speed touches something that moves, and
// the static map leaves room.
struct Place {
  double margin_m = 0;  // that the robot is to keep clear of everything
  Crossing crossing;
  GroundPlane ground;
  std::vector<TimedPose> straight_way;
  Verdict straight;
  std::shared_ptr<const StateChecker> checker;  // the server's version, for the robot with margin
};

// The first of the problem's places, if need be before another moving object than the one whose way
// is crossed. With `hindsight`, what the map shows at the end, it has to leave room as well: what
// is seen later may stand at the goal. NOT_FOUND if there is none; `void_places` gets the reasons.
// Another error is the server's.
absl::StatusOr<Place> ChoosePlace(const std::shared_ptr<Connection>& connection,
                                  const SceneSnapshot& scene, const ScenePtr& hindsight,
                                  const Problem& problem, const Truth& truth,
                                  const PlanSettings& settings,
                                  std::vector<std::string>& void_places);

}  // namespace clearway::demo
