// Motions against states at many of their times.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clearway/collision/scene_checker.h"
#include "clearway/scene/scene_builder.h"
#include "collision/random_motions.h"
#include "collision/test_world.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

struct Counts {
  int motions = 0, tolerated = 0, unresolved = 0, unresolved_tolerated = 0, with_voxel = 0;
  std::array<int, 6> by_status{};
  int Of(SpaceStatus status) const { return by_status[static_cast<std::size_t>(status)]; }
};

// `count` times from `from` on, the last at `until`.
std::vector<Time> TimesIn(Time from, Time until, int count) {
  std::vector<Time> times;
  for (int i = 0; i < count; ++i)
    times.push_back(from + (until - from) * i / std::max(1, count - 1));
  return times;
}

// At the time at which the world stands still, if it does.
StateBatch InTheWorld(const MotionOptions& options, StateBatch states) {
  if (options.world_at) states.times.assign(states.times.size(), *options.world_at);
  return states;
}

void CheckMotions(const SceneChecker& checker, const Asked& asked, const MotionOptions& options,
                  int samples, Counts& counts) {
  const auto reply = checker.CheckMotions(asked.motions, options);
  ASSERT_TRUE(reply.ok()) << reply.status();
  ASSERT_EQ(reply->answers.size(), asked.count());
  const bool tolerated = options.check.unknown == UnknownPolicy::kTolerated;
  std::size_t first = 0;
  for (std::size_t m = 0; m < asked.count(); ++m) {
    const MotionAnswer& answer = reply->answers[m];
    const std::size_t knots = asked.motions.knot_counts[m];
    const Time from = asked.motions.times[first], until = asked.motions.times[first + knots - 1];
    ++counts.motions;
    counts.tolerated += tolerated;
    ++counts.by_status[static_cast<std::size_t>(answer.status)];
    const bool unresolved = answer.status == SpaceStatus::kUnresolved;
    counts.unresolved += unresolved;
    counts.unresolved_tolerated += unresolved && tolerated;
    ASSERT_GE(answer.free_until, from);
    ASSERT_LE(answer.free_until, until);
    ASSERT_EQ(answer.status == SpaceStatus::kFree, answer.free_until == until && !answer.witness);
    ASSERT_EQ(answer.witness.has_value(), !unresolved && answer.status != SpaceStatus::kFree);
    if (answer.free_until > from) {
      const StateBatch states = InTheWorld(
          options,
          StatesAt(asked, first, knots, TimesIn(from, answer.free_until - Duration(1), samples)));
      const auto truth = checker.Check(states, options.check);
      ASSERT_TRUE(truth.ok()) << truth.status();
      for (std::size_t s = 0; s < truth->answers.size(); ++s) {
        ASSERT_EQ(truth->answers[s].status, SpaceStatus::kFree)
            << "motion " << m << ", sample " << s << " of " << samples;
      }
    }
    if (answer.witness) {
      EXPECT_EQ(answer.witness->from, answer.free_until);
      const auto truth =
          checker.Check(InTheWorld(options, StatesAt(asked, first, knots, {answer.witness->until})),
                        options.check);
      ASSERT_TRUE(truth.ok()) << truth.status();
      EXPECT_EQ(truth->answers[0].status, answer.status);
      EXPECT_EQ(truth->answers[0].link, answer.witness->link);
      EXPECT_EQ(truth->answers[0].object, answer.witness->object);
      counts.with_voxel += answer.witness->voxel.has_value();
    }
    first += knots;
  }
}

TEST(MotionCheck, NothingCalledFreeIsInContact) {
  Counts counts;
  for (std::uint32_t seed = 0; seed < 150; ++seed) {
    RandomWorld random(7000 + seed);
    const ScenePtr scene = random.Scene();
    const Robot robot =
        seed % 2 == 0 ? random.AnyRobot() : Robot::SingleShape("one", random.AnyShape());
    const SceneChecker checker(scene, robot);
    const Asked asked = RandomMotions(random, robot, 20);
    MotionOptions options = RandomMotionOptions(random, robot);
    if (seed % 4 == 0) options.world_at = random.States(robot, 1).times[0];
    CheckMotions(checker, asked, options, 200, counts);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
  std::cout << counts.motions << " motions, " << counts.unresolved << " unresolved, "
            << counts.unresolved_tolerated << " of them with tolerated unknown space of "
            << counts.tolerated << "; " << counts.with_voxel << " with a voxel;";
  for (int s = 0; s < 6; ++s) {
    std::cout << " " << counts.by_status[s] << " " << ToString(static_cast<SpaceStatus>(s)) << ",";
  }
  std::cout << "\n";
  for (const SpaceStatus status :
       {SpaceStatus::kFree, SpaceStatus::kUnknownSpace, SpaceStatus::kBeyondHorizon,
        SpaceStatus::kOccupied, SpaceStatus::kOutOfBounds}) {
    EXPECT_GT(counts.Of(status), counts.motions / 20) << ToString(status);
  }
  EXPECT_LE(1000 * counts.unresolved, counts.motions);
  EXPECT_GT(counts.with_voxel, counts.motions / 5);
}

// Where a nanosecond before the end of what was proved free the robot touched something, by
// rounding.
TEST(MotionCheck, WhatIsFreeIsNotTouchedByRounding) {
  RandomWorld random(90518);
  const ScenePtr scene = random.Scene();
  const Robot robot = random.AnyRobot();
  const SceneChecker checker(scene, robot);
  const Asked asked = RandomMotions(random, robot, 20);
  Counts counts;
  CheckMotions(checker, asked, RandomMotionOptions(random, robot), 200, counts);
  EXPECT_EQ(counts.motions, 20);
}

// From (-2, 0, 0) to (2, 0, 0) in 2 s past a wall whose near side is at x = 1.
class MotionCheckAtAWall : public testing::Test {
 protected:
  MotionCheckAtAWall() {
    auto scene = std::make_shared<SceneSnapshot>(SceneSnapshot::Empty(SceneParams{}));
    for (std::int32_t y = -10; y < 10; ++y) {
      for (std::int32_t z = -10; z < 10; ++z) scene->static_map_W.Set({10, y, z}, 100);
    }
    scene_ = scene;
    options_.check.unknown = UnknownPolicy::kFree;
    motions_.knot_counts = {2};
    motions_.times = {Time(), Time() + FromSeconds(2)};
    motions_.T_W_L = {Pose::Translation(-2, 0, 0), Pose::Translation(2, 0, 0)};
  }

  absl::StatusOr<MotionReply> Ask() const {
    return SceneChecker(scene_, Robot::SingleShape("ball", Sphere{0.5}))
        .CheckMotions(motions_, options_);
  }

  ScenePtr scene_;
  MotionBatch motions_;
  MotionOptions options_;
};

TEST_F(MotionCheckAtAWall, FindsTheContact) {
  const auto dut = Ask();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const MotionAnswer& answer = dut->answers[0];
  EXPECT_EQ(answer.status, SpaceStatus::kOccupied);
  ASSERT_TRUE(answer.witness.has_value());
  const double contact_s = 1.25;                                         // at x = 0.5
  EXPECT_NEAR(ToSeconds(answer.free_until - Time()), contact_s, 0.006);  // 1 cm
  EXPECT_LE(ToSeconds(answer.free_until - Time()), contact_s);
  EXPECT_GE(ToSeconds(answer.witness->until - Time()), contact_s - 1e-6);
  EXPECT_LE(ToSeconds(answer.witness->until - answer.witness->from), 0.006);
  ASSERT_TRUE(answer.witness->voxel.has_value());
  EXPECT_EQ(answer.witness->voxel->x, 10);
}

TEST_F(MotionCheckAtAWall, DeviationsAndPaddingKeepAway) {
  motions_.T_W_L[1] = Pose::Translation(0.4, 0, 0);  // 0.1 m before it
  EXPECT_EQ(Ask()->answers[0].status, SpaceStatus::kFree);
  motions_.deviations_m = {0.09, 0};
  EXPECT_EQ(Ask()->answers[0].status, SpaceStatus::kFree);
  motions_.deviations_m = {0.11, 0};
  EXPECT_EQ(Ask()->answers[0].status, SpaceStatus::kUnresolved);
  motions_.deviations_m.clear();
  options_.check.padding_m = 0.11;
  EXPECT_EQ(Ask()->answers[0].status, SpaceStatus::kOccupied);
}

// Times are whole nanoseconds: the middle of an odd number of them is nearer to one end.
TEST(MotionCheckInNanoseconds, ATurnThatEndsInContactIsNotFree) {
  const auto yaw = [](double rad) {
    return Pose{Eigen::Quaterniond(Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitZ())), {0, 0, 0}};
  };
  for (const double turn_rad : {0.3, 0.6, 1.0}) {
    TestWorld world;
    world.Given(1, Box{{0.1, 0.1, 0.1}},
                Pose::Translation(0.95 * std::cos(turn_rad), 0.95 * std::sin(turn_rad), 0));
    const SceneChecker checker(world.Scene(), Robot::SingleShape("bar", Box{{2, 0.1, 0.1}}));
    for (const int lasts_ns : {1, 2, 3, 5, 9, 13, 25, 101, 501}) {
      MotionOptions options;
      options.check.unknown = UnknownPolicy::kFree;
      const auto dut = checker.CheckMotions(
          {{2}, {kTestStart, kTestStart + Duration(lasts_ns)}, {yaw(0), yaw(turn_rad)}, {}},
          options);
      ASSERT_TRUE(dut.ok()) << dut.status();
      EXPECT_NE(dut->answers[0].status, SpaceStatus::kFree) << turn_rad << " " << lasts_ns;
    }
  }
}

// Where unknown space is tolerated motions are looked at in steps, which no motion is too short
// for.
TEST(MotionCheckInNanoseconds, EndsWhereUnknownSpaceIsTolerated) {
  const SceneChecker checker(TestWorld().Scene(), Robot::SingleShape("box", Box{{1, 1, 1}}));
  MotionOptions options;
  options.check.unknown = UnknownPolicy::kTolerated;
  options.check.max_unknown_fraction = 0.5;
  options.check.known_free_W = {{{-9, -9, -9}, {0, 9, 9}}};
  for (const int lasts_ns : {1, 2, 3, 100, 10'000}) {
    for (const double resolution_m : {1e-2, 1e-4}) {
      options.contact_resolution_m = resolution_m;
      const auto dut =
          checker.CheckMotions({{2},
                                {kTestStart, kTestStart + Duration(lasts_ns)},
                                {Pose::Translation(-0.3, 0, 0), Pose::Translation(0.7, 0, 0)},
                                {}},
                               options);
      ASSERT_TRUE(dut.ok()) << dut.status();
      EXPECT_NE(dut->answers[0].status, SpaceStatus::kFree) << lasts_ns << " " << resolution_m;
    }
  }
}

// A padding of hundreds of metres has millions of blocks to look at.
TEST_F(MotionCheckAtAWall, EndsOrMayBeCancelledHoweverMuchThereIsToLookAt) {
  options_.check.unknown = UnknownPolicy::kBlocked;
  options_.check.padding_m = 1000;
  const auto dut = Ask();  // at once: the wall and unknown space are within the padding
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->answers[0].status, SpaceStatus::kOccupied);
  options_.check.known_free_W = {{{-2e4, -2e4, -2e4}, {2e4, 2e4, 2e4}}};  // for hours
  int asked = 0;
  const SceneChecker checker(scene_, Robot::SingleShape("ball", Sphere{0.5}));
  const auto cancelled = checker.CheckMotions(motions_, options_, [&] { return ++asked > 3; });
  EXPECT_TRUE(absl::IsCancelled(cancelled.status())) << cancelled.status();
}

// Differences overflow, and what is no number must not pass for a gap.
TEST_F(MotionCheckAtAWall, FarOffIsNotFree) {
  for (const double far_m : {1e6, 1e154, 1e308}) {
    motions_.T_W_L = {Pose::Translation(-far_m, far_m, 5), Pose::Translation(far_m, -far_m, 5)};
    EXPECT_EQ(Ask()->answers[0].status, SpaceStatus::kOutOfBounds) << far_m;
    motions_.T_W_L[0] = Pose::Translation(0, 0, 5);
    EXPECT_NE(Ask()->answers[0].status, SpaceStatus::kFree) << far_m;
    EXPECT_LT(Ask()->answers[0].free_until, motions_.times[1]) << far_m;
  }
}

// An object that crosses the way at once is in it only while the world moves.
TEST_F(MotionCheckAtAWall, TheWorldMayStandStill) {
  TestWorld world;
  world.Free({{-4, -4, -4}, {4, 4, 4}});
  world.Object(1, VoxelCuboid({-2, -2, -2}, {2, 2, 2}), Pose::Translation(0, -3, 0),
               Twist{.linear = {0, 3, 0}});
  scene_ = world.Scene();
  motions_.times = {kTestStart, kTestStart + FromSeconds(2)};
  EXPECT_EQ(Ask()->answers[0].status, SpaceStatus::kOccupied);
  options_.world_at = kTestStart;
  EXPECT_EQ(Ask()->answers[0].status, SpaceStatus::kFree);
  options_.world_at = kTestStart + FromSeconds(1);
  const auto blocked = Ask();
  EXPECT_EQ(blocked->answers[0].status, SpaceStatus::kOccupied);
  EXPECT_EQ(blocked->answers[0].witness->object, 1);
  options_.world_at = Time::max();
  EXPECT_THAT(std::string(Ask().status().message()), testing::HasSubstr("world_at_ns"));
}

TEST_F(MotionCheckAtAWall, BadInputIsNamed) {
  const auto message = [this] { return std::string(Ask().status().message()); };
  const MotionBatch good = motions_;
  motions_.knot_counts = {1};
  EXPECT_THAT(message(), testing::HasSubstr("knot_counts[0] is 1"));
  motions_.knot_counts = {3};
  EXPECT_THAT(message(), testing::HasSubstr("times_ns has 2 knots"));
  motions_.knot_counts = {};
  EXPECT_THAT(message(), testing::HasSubstr("times_ns has 2 knots"));
  motions_ = good;
  motions_.times[1] = motions_.times[0];
  EXPECT_THAT(message(), testing::HasSubstr("times_ns[1] is not later"));
  motions_ = good;
  motions_.deviations_m = {0.1};
  EXPECT_THAT(message(), testing::HasSubstr("deviations_m has 1 entries"));
  motions_.deviations_m = {0.1, std::nan("")};
  EXPECT_THAT(message(), testing::HasSubstr("deviations_m[1] is nan"));
  motions_ = good;
  options_.check.clearance_up_to_m = 1;
  EXPECT_THAT(message(), testing::HasSubstr("clearance_up_to_m"));
  options_.check.clearance_up_to_m.reset();
  options_.contact_resolution_m = 0;
  EXPECT_THAT(message(), testing::HasSubstr("contact_resolution_m is 0"));
}

}  // namespace
}  // namespace clearway
