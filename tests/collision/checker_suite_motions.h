// The part of CheckerSuite on motions.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "collision/checker_fixture.h"
#include "collision/random_motions.h"

namespace clearway {

inline void ExpectSameAnswer(const MotionAnswer& a, const MotionAnswer& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.free_until, b.free_until);
  ASSERT_EQ(a.witness.has_value(), b.witness.has_value());
  if (!a.witness) return;
  EXPECT_EQ(a.witness->from, b.witness->from);
  EXPECT_EQ(a.witness->until, b.witness->until);
  EXPECT_EQ(a.witness->link, b.witness->link);
  EXPECT_EQ(a.witness->object, b.witness->object);
  EXPECT_EQ(a.witness->voxel, b.witness->voxel);
}

TYPED_TEST_P(CheckerSuite, MotionsAreAnsweredAsByTheLocalChecker) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    RandomWorld random(100 + seed);
    const ScenePtr scene = random.Scene();
    const Robot robot = random.AnyRobot();
    Asked asked = RandomMotions(random, robot, 60);
    if (seed % 2 == 0) asked.motions.deviations_m.assign(asked.motions.T_W_L.size(), 0.01);
    const MotionOptions options = RandomMotionOptions(random, robot);
    const auto dut = this->factory_.Make(scene, robot);
    const auto reply = dut->CheckMotions(asked.motions, options);
    ASSERT_TRUE(reply.ok()) << reply.status();
    const auto expected = SceneChecker(scene, robot).CheckMotions(asked.motions, options);
    ASSERT_TRUE(expected.ok()) << expected.status();
    EXPECT_EQ(reply->version, dut->version());
    EXPECT_EQ(reply->stamp, dut->stamp());
    EXPECT_EQ(reply->horizon, scene->params.horizon);
    ASSERT_EQ(reply->answers.size(), asked.count());
    for (std::size_t m = 0; m < asked.count(); ++m) {
      SCOPED_TRACE(m);
      ExpectSameAnswer(reply->answers[m], expected->answers[m]);
    }
  }
}

// From the middle of the room to its wall at x = 2 m, and back from before it.
inline MotionBatch ToTheWallAndBack() {
  const auto at = [](double x_m) { return Pose::Translation(x_m, 0, 0); };
  return {{2, 3},
          {kTestStart, kTestStart + FromSeconds(2), kTestStart, kTestStart + FromSeconds(1),
           kTestStart + FromSeconds(2)},
          {at(0), at(2), at(1), at(0), at(-1)},
          {}};
}

TYPED_TEST_P(CheckerSuite, MotionsAreProvedFreeOrShowTheirFirstContact) {
  const auto dut = this->Make(this->Room(), this->Ball());
  const auto reply = dut->CheckMotions(ToTheWallAndBack(), {.check = this->UnknownIsFree()});
  ASSERT_TRUE(reply.ok()) << reply.status();
  ASSERT_EQ(reply->answers.size(), 2u);
  const MotionAnswer &blocked = reply->answers[0], &free = reply->answers[1];
  EXPECT_EQ(blocked.status, SpaceStatus::kOccupied);
  ASSERT_TRUE(blocked.witness.has_value());
  EXPECT_NEAR(ToSeconds(blocked.witness->from - kTestStart), 1.75, 0.01);
  EXPECT_NEAR(ToSeconds(blocked.witness->until - kTestStart), 1.75, 0.01);
  EXPECT_EQ(blocked.witness->link, 0);
  EXPECT_EQ(blocked.witness->object, kStaticLabel);
  ASSERT_TRUE(blocked.witness->voxel.has_value());
  EXPECT_EQ(blocked.witness->voxel->x, 20);
  EXPECT_EQ(free.status, SpaceStatus::kFree);
  EXPECT_FALSE(free.witness.has_value());
  EXPECT_EQ(free.free_until, kTestStart + FromSeconds(2));
}

TYPED_TEST_P(CheckerSuite, NoMotionsAreAValidQuestion) {
  const auto dut = this->Make(this->Room(), this->Ball());
  const auto reply = dut->CheckMotions({}, {.check = this->UnknownIsFree()});
  ASSERT_TRUE(reply.ok()) << reply.status();
  EXPECT_TRUE(reply->answers.empty());
  EXPECT_EQ(reply->version, dut->version());
  MotionOptions bad;
  bad.contact_resolution_m = 0;
  EXPECT_TRUE(absl::IsInvalidArgument(dut->CheckMotions({}, bad).status()));
}

TYPED_TEST_P(CheckerSuite, RefusesMotionsThatDoNotFit) {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto dut = this->Make(this->Room(), this->Ball());
  const std::vector<std::function<void(MotionBatch&, MotionOptions&)>> spoilers = {
      [](auto& m, auto&) {
        m.knot_counts = {1, 4};
      },
      [](auto& m, auto&) { m.knot_counts = {2}; },
      [](auto& m, auto&) {
        m.knot_counts = {2, 4};
      },
      [](auto& m, auto&) { m.times[1] = m.times[0]; },
      [](auto& m, auto&) { m.times[4] = m.times[2]; },
      [](auto& m, auto&) { m.times[0] = Time::min(); },
      [](auto& m, auto&) { m.T_W_L.pop_back(); },
      [](auto& m, auto&) { m.T_W_L[3].translation.x() = kNaN; },
      [](auto& m, auto&) { m.T_W_L[0].rotation.coeffs() *= 2; },
      [](auto& m, auto&) { m.deviations_m = {0.1}; },
      [](auto& m, auto&) {
        m.deviations_m = {0, 0, -0.1, 0, 0};
      },
      [](auto& m, auto&) {
        m.deviations_m = {0, 0, kNaN, 0, 0};
      },
      [](auto&, auto& o) { o.contact_resolution_m = kNaN; },
      [](auto&, auto& o) { o.contact_resolution_m = 11; },
      [](auto&, auto& o) { o.check.clearance_up_to_m = 1; },
      [](auto&, auto& o) { o.check.with_unknown_fraction = true; },
      [](auto&, auto& o) { o.check.padding_m = -1; },
  };
  for (std::size_t i = 0; i < spoilers.size(); ++i) {
    MotionBatch motions = ToTheWallAndBack();
    MotionOptions options;
    spoilers[i](motions, options);
    EXPECT_TRUE(absl::IsInvalidArgument(dut->CheckMotions(motions, options).status())) << i;
  }
}

}  // namespace clearway
