// The suite of every checker, on scenes that are mirrored and on a server.
#include "clearway/client/remote_checker.h"
#include "clearway/client/scene_mirror.h"
#include "collision/checker_suite.h"
#include "support/test_server.h"

namespace clearway {
namespace {

// A checker with what it depends on.
class Kept : public StateChecker {
 public:
  Kept(std::shared_ptr<const void> kept, std::unique_ptr<const StateChecker> checker)
      : kept_(std::move(kept)), checker_(std::move(checker)) {}

  absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                   const CheckOptions& options) const override {
    return checker_->Check(states, options);
  }
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions& options) const override {
    return checker_->CheckMotions(motions, options);
  }
  const Robot& robot() const override { return checker_->robot(); }
  std::uint64_t version() const override { return checker_->version(); }
  Time stamp() const override { return checker_->stamp(); }

 private:
  std::shared_ptr<const void> kept_;
  std::unique_ptr<const StateChecker> checker_;
};

// A small batch limit: large batches of the suite go in pieces.
std::shared_ptr<testing_support::TestServer> ServerWith(ScenePtr scene) {
  ServerConfig config = testing_support::SmallConfig();
  config.limits.max_states_per_batch = 100;
  auto server = std::make_shared<testing_support::TestServer>(config);
  server->core().versions.Publish(std::move(scene));
  return server;
}

struct Remote {
  static std::shared_ptr<const StateChecker> Make(ScenePtr scene, Robot robot) {
    const auto server = ServerWith(std::move(scene));
    auto checker = RemoteChecker::Pin(server->Connect(), std::move(robot));
    EXPECT_TRUE(checker.ok()) << checker.status();
    return std::make_shared<Kept>(server, *std::move(checker));
  }
};

ScenePtr MirrorOf(const ScenePtr& scene, const SceneMirrorOptions& options) {
  const auto server = ServerWith(scene);
  auto mirror = SceneMirror::Follow(server->Connect(), options);
  EXPECT_TRUE(mirror.ok()) << mirror.status();
  auto mirrored = (*mirror)->WaitFor(scene->version, std::chrono::seconds(60));
  EXPECT_TRUE(mirrored.ok()) << mirrored.status();
  return *std::move(mirrored);
}

struct Mirrored {
  static std::shared_ptr<const StateChecker> Make(ScenePtr scene, Robot robot) {
    const ScenePtr mirrored = MirrorOf(scene, {});
    EXPECT_EQ(mirrored->Hash(), scene->Hash());
    return std::make_shared<SceneChecker>(mirrored, std::move(robot));
  }
};

struct MirroredStates {
  static std::shared_ptr<const StateChecker> Make(ScenePtr scene, Robot robot) {
    return std::make_shared<SceneChecker>(MirrorOf(scene, {.states_only = true}), std::move(robot));
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Remote, CheckerSuite, Remote);
INSTANTIATE_TYPED_TEST_SUITE_P(Mirrored, CheckerSuite, Mirrored);
INSTANTIATE_TYPED_TEST_SUITE_P(MirroredStates, CheckerSuite, MirroredStates);

}  // namespace
}  // namespace clearway
