// What the tests of CheckerSuite share (see checker_suite.h).
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>

#include "clearway/collision/state_checker.h"
#include "collision/test_world.h"

namespace clearway {

template <class Factory>
class CheckerSuite : public ::testing::Test {
 protected:
  std::shared_ptr<const StateChecker> Make(const TestWorld& world, Robot robot) {
    return factory_.Make(world.Scene(), std::move(robot));
  }
  // The answer to one state; an error fails the test.
  static StateAnswer Ask(const StateChecker& dut, const StateBatch& state,
                         const CheckOptions& options = {}) {
    const auto reply = dut.Check(state, options);
    EXPECT_TRUE(reply.ok()) << reply.status();
    if (!reply.ok() || reply->answers.size() != 1) return {};
    return reply->answers[0];
  }
  static CheckOptions UnknownIsFree() {
    CheckOptions options;
    options.unknown = UnknownPolicy::kFree;
    return options;
  }
  static CheckOptions WithUnknownFraction() {
    CheckOptions options;
    options.with_unknown_fraction = true;
    return options;
  }
  // 4 m of known free space each way, with a wall of occupied voxels at x = 2 to 2.1 m.
  static TestWorld Room(SceneParams params = {}) {
    TestWorld world(std::move(params));
    world.Free({{-4, -4, -4}, {4, 4, 4}}).Occupied({{2, -1, -1}, {2.1, 1, 1}});
    return world;
  }
  static Robot Ball(double radius_m = 0.25) { return Robot::SingleShape("ball", Sphere{radius_m}); }
  static Robot TwoBalls() {
    return {"two", {{"a", {{Sphere{0.25}, Pose{}}}}, {"b", {{Sphere{0.25}, Pose{}}}}}};
  }

  Factory factory_;
};

inline void ExpectAnswer(const StateAnswer& answer, SpaceStatus status, int link, ObjectId object) {
  EXPECT_EQ(answer.status, status) << ToString(answer.status);
  EXPECT_EQ(answer.link, link);
  EXPECT_EQ(answer.object, object);
}

TYPED_TEST_SUITE_P(CheckerSuite);

}  // namespace clearway
