// The part of CheckerSuite on whole batches: random ones, from many threads, and refused ones.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <thread>
#include <vector>

#include "clearway/collision/scene_checker.h"
#include "collision/checker_fixture.h"
#include "collision/random_world.h"

namespace clearway {

inline void ExpectSameAnswers(const CheckReply& a, const CheckReply& b) {
  ASSERT_EQ(a.answers.size(), b.answers.size());
  for (std::size_t s = 0; s < a.answers.size(); ++s) {
    EXPECT_EQ(a.answers[s].status, b.answers[s].status) << "state " << s;
    EXPECT_EQ(a.answers[s].link, b.answers[s].link) << "state " << s;
    EXPECT_EQ(a.answers[s].object, b.answers[s].object) << "state " << s;
    EXPECT_EQ(a.answers[s].unknown_fraction, b.answers[s].unknown_fraction);
    ASSERT_EQ(a.answers[s].clearance_m.has_value(), b.answers[s].clearance_m.has_value());
    EXPECT_NEAR(a.answers[s].clearance_m.value_or(0), b.answers[s].clearance_m.value_or(0), 1e-9);
  }
}

TYPED_TEST_P(CheckerSuite, AnswersAreThoseOfTheLocalChecker) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    RandomWorld random(seed);
    const ScenePtr scene = random.Scene();
    const Robot robot = random.AnyRobot();
    const StateBatch states = random.States(robot, 60);
    const CheckOptions options = random.Options(robot);
    const auto dut = this->factory_.Make(scene, robot);
    const auto reply = dut->Check(states, options);
    ASSERT_TRUE(reply.ok()) << reply.status();
    const auto expected = SceneChecker(scene, robot).Check(states, options);
    ASSERT_TRUE(expected.ok()) << expected.status();
    ExpectSameAnswers(*reply, *expected);
  }
}

TYPED_TEST_P(CheckerSuite, ManyThreadsGetTheSameAnswers) {
  RandomWorld random(11);
  const ScenePtr scene = random.Scene();
  const Robot robot = random.AnyRobot();
  const StateBatch states = random.States(robot, 60);
  const CheckOptions options = random.Options(robot);
  const auto dut = this->factory_.Make(scene, robot);
  const auto alone = dut->Check(states, options);
  ASSERT_TRUE(alone.ok()) << alone.status();
  std::vector<absl::StatusOr<CheckReply>> replies(4, absl::UnknownError("not asked"));
  std::vector<std::thread> threads;
  for (auto& reply : replies) {
    threads.emplace_back([&] { reply = dut->Check(states, options); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& reply : replies) {
    ASSERT_TRUE(reply.ok()) << reply.status();
    ExpectSameAnswers(*reply, *alone);
  }
}

TYPED_TEST_P(CheckerSuite, RefusesBatchesThatDoNotFit) {
  const auto dut = this->Make(this->Room(), this->TwoBalls());
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Pose stretched, not_finite = Pose::Translation(kNaN, 0, 0), infinite, zero;
  stretched.rotation.coeffs() << 0, 0, 0, 1.1;
  infinite.translation.x() = std::numeric_limits<double>::infinity();
  zero.rotation.coeffs().setZero();
  const std::vector<StateBatch> refused = {
      {{kTestStart}, {}},
      {{}, {Pose{}, Pose{}}},
      {{kTestStart}, {Pose{}}},
      {{kTestStart}, {Pose{}, Pose{}, Pose{}}},
      {{kTestStart}, {Pose{}, stretched}},
      {{kTestStart}, {Pose{}, not_finite}},
      {{kTestStart}, {infinite, Pose{}}},
      {{kTestStart}, {zero, Pose{}}},
      {{Time::min()}, {Pose{}, Pose{}}},
      {{Time::max()}, {Pose{}, Pose{}}},
  };
  for (std::size_t i = 0; i < refused.size(); ++i) {
    const auto reply = dut->Check(refused[i], {});
    EXPECT_EQ(reply.status().code(), absl::StatusCode::kInvalidArgument) << "batch " << i;
  }
}

TYPED_TEST_P(CheckerSuite, RefusesOptionsOutOfRange) {
  const auto dut = this->Make(this->Room(), this->TwoBalls());
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(CheckOptions&)>> spoilers = {
      [](CheckOptions& o) { o.padding_m = -0.1; },
      [](CheckOptions& o) { o.padding_m = kNaN; },
      [](CheckOptions& o) { o.inflation_mps = -1; },
      [](CheckOptions& o) { o.bound_multiple = 101; },
      [](CheckOptions& o) { o.bound_multiple = -1; },
      [](CheckOptions& o) { o.bound_multiple = kNaN; },
      [](CheckOptions& o) { o.max_unknown_fraction = 1.5; },
      [](CheckOptions& o) { o.clearance_up_to_m = -1; },
      [](CheckOptions& o) { o.clearance_up_to_m = kNaN; },
      [](CheckOptions& o) {
        o.known_free_W = {{{1, 0, 0}, {0, 1, 1}}};
      },
      [](CheckOptions& o) {
        o.known_free_W = {{{kNaN, 0, 0}, {0, 1, 1}}};
      },
      [](CheckOptions& o) { o.ignored_objects = {0}; },
      [](CheckOptions& o) {
        o.allowed_contacts = {{2, 1}};
      },
      [](CheckOptions& o) {
        o.allowed_contacts = {{-1, 1}};
      },
      [](CheckOptions& o) {
        o.allowed_contacts = {{0, -1}};
      },
  };
  for (std::size_t i = 0; i < spoilers.size(); ++i) {
    CheckOptions options;
    options.unknown = UnknownPolicy::kTolerated;
    spoilers[i](options);
    const auto reply = dut->Check({{kTestStart}, {Pose{}, Pose{}}}, options);
    EXPECT_EQ(reply.status().code(), absl::StatusCode::kInvalidArgument) << "options " << i;
  }
}

}  // namespace clearway
