#include "closed_loop/loop.h"

#include <gtest/gtest.h>

namespace clearway::closed_loop {
namespace {

LoopResult Drive(const Course& course, const LoopOptions& options) {
  OwnScene scene;
  const auto result = RunLoop(course, options, scene);
  EXPECT_TRUE(result.ok()) << result.status();
  return result.ok() ? *result : LoopResult();
}

TEST(LoopTest, TouchesNothingThatKeepsItsMotion) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const LoopResult result =
        Drive(MakeCourse(seed, Traffic::kSteady), MakeLoopOptions(false, true, seed));
    EXPECT_TRUE(result.arrival) << seed;
    EXPECT_TRUE(result.collisions.empty()) << seed;
  }
}

TEST(LoopTest, TouchesNothingThatStands) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    for (const bool noise : {false, true}) {
      const LoopResult result =
          Drive(MakeCourse(seed, Traffic::kTurning), MakeLoopOptions(noise, true, seed));
      EXPECT_EQ(result.driven.size(), 300u);
      for (const Collision& collision : result.collisions) EXPECT_NE(collision.object, 0);
    }
  }
}

TEST(LoopTest, TheSameLoopEndsAlike) {
  const Course course = MakeCourse(5, Traffic::kTurning);
  LoopOptions options = MakeLoopOptions(true, true, 5);
  options.lasts = std::chrono::seconds(8);
  const LoopResult once = Drive(course, options), again = Drive(course, options);
  ASSERT_EQ(once.driven.size(), again.driven.size());
  for (std::size_t i = 0; i < once.driven.size(); ++i) {
    EXPECT_EQ(once.driven[i].p_W, again.driven[i].p_W) << i;
  }
}

// Takes the scans and shows nothing of them, so that the robot drives blindly.
class NothingSeen : public SceneFeed {
 public:
  NothingSeen() : pool_(1), builder_(LoopSceneParams(), FrameLimits(), pool_) {}
  absl::StatusOr<ScenePtr> Push(const Frame&) override { return builder_.Publish(); }

 private:
  ThreadPool pool_;
  SceneBuilder builder_;
};

TEST(LoopTest, ABlindRobotIsFoundOut) {
  int with_walls = 0, with_objects = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    NothingSeen scene;
    const auto result =
        RunLoop(MakeCourse(seed, Traffic::kTurning), MakeLoopOptions(false, true, seed), scene);
    ASSERT_TRUE(result.ok()) << result.status();
    for (const Collision& collision : result->collisions) {
      ++(collision.object == kStaticLabel ? with_walls : with_objects);
      EXPECT_TRUE(collision.InTime());
    }
  }
  EXPECT_GT(with_walls, 0);
  EXPECT_GT(with_objects, 0);
}

}  // namespace
}  // namespace clearway::closed_loop
