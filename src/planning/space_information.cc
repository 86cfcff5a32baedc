#include "clearway/planning/space_information.h"

#include <ompl/util/Exception.h>

#include <utility>

#include "absl/strings/str_cat.h"
#include "clearway/planning/motion_validator.h"
#include "clearway/planning/validity_checker.h"

namespace clearway {

namespace ob = ompl::base;

absl::StatusOr<ob::SpaceInformationPtr> MakeSpaceInformation(
    ob::StateSpacePtr space, std::shared_ptr<const StateChecker> checker, StateMapping mapping,
    PlanningOptions options) {
  if (space == nullptr) return absl::InvalidArgumentError("space: null");
  if (checker == nullptr) return absl::InvalidArgumentError("checker: null");
  if (absl::Status status = Validate(options, checker->robot()); !status.ok()) return status;
  if (absl::Status status = mapping.ValidateSpace(*space, checker->robot()); !status.ok()) {
    return status;
  }
  auto si = std::make_shared<ob::SpaceInformation>(space);
  auto query = std::make_shared<const StateQuery>(std::move(space), std::move(checker),
                                                  std::move(mapping), std::move(options));
  si->setStateValidityChecker(std::make_shared<SceneValidityChecker>(si, query));
  si->setMotionValidator(std::make_shared<SceneMotionValidator>(si, query));
  try {
    si->setup();
  } catch (const ompl::Exception& e) {
    return absl::InvalidArgumentError(absl::StrCat("space: refused by OMPL: ", e.what()));
  }
  return si;
}

const StateQuery* QueryOf(const ob::SpaceInformation& si) {
  const auto* checker =
      dynamic_cast<const SceneValidityChecker*>(si.getStateValidityChecker().get());
  return checker == nullptr ? nullptr : &checker->query();
}

}  // namespace clearway
