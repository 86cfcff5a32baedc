// The suite that every checker passes, for the checker in this process.
#include "collision/checker_suite.h"

namespace clearway {
namespace {

struct LocalFactory {
  std::shared_ptr<const StateChecker> Make(ScenePtr scene, Robot robot) {
    return std::make_shared<SceneChecker>(std::move(scene), std::move(robot));
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Local, CheckerSuite, LocalFactory);

}  // namespace
}  // namespace clearway
