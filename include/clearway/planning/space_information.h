// A planning space over a StateChecker: the same lines for a local, a mirrored and a remote one.
//
//   auto si = MakeSpaceInformation(space, checker, StateMapping::Se2(checker->robot(), {}, time),
//   {}); ompl::geometric::SimpleSetup setup(*si);
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <memory>

#include "absl/status/statusor.h"
#include "clearway/planning/state_query.h"

namespace clearway {

// A space information, set up, whose states and motions are checked by SceneValidityChecker and
// SceneMotionValidator over one StateQuery. The checker pins one scene version, so every answer of
// a solve is of that version; for a newer one, make a new space information. INVALID_ARGUMENT if
// the mapping does not fit the space, for bad options, or if OMPL refuses the space (no bounds).
absl::StatusOr<ompl::base::SpaceInformationPtr> MakeSpaceInformation(
    ompl::base::StateSpacePtr space, std::shared_ptr<const StateChecker> checker,
    StateMapping mapping, PlanningOptions options);

// The query of a space information that MakeSpaceInformation made; null for any other.
const StateQuery* QueryOf(const ompl::base::SpaceInformation& si);

}  // namespace clearway
