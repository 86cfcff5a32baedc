// Departure intervals against closed forms.
#include "clearway/collision/departure_intervals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "clearway/collision/scene_checker.h"
#include "collision/test_world.h"

namespace clearway {
namespace {

// Counts the calls.
class Counted : public StateChecker {
 public:
  explicit Counted(const StateChecker& checker) : checker_(checker) {}
  absl::StatusOr<CheckReply> Check(const StateBatch& states,
                                   const CheckOptions& options) const override {
    return checker_.Check(states, options);
  }
  absl::StatusOr<MotionReply> CheckMotions(const MotionBatch& motions,
                                           const MotionOptions& options) const override {
    ++calls;
    asked += static_cast<int>(motions.knot_counts.size());
    return checker_.CheckMotions(motions, options);
  }
  const Robot& robot() const override { return checker_.robot(); }
  std::uint64_t version() const override { return checker_.version(); }
  Time stamp() const override { return checker_.stamp(); }

  mutable int calls = 0, asked = 0;

 private:
  const StateChecker& checker_;
};

// A ball of 0.25 m along x. At `crossing_s` another one goes through the origin along y; 4 m of
// known free space each way, with a wall at y = 2.
class DepartureIntervals : public testing::Test {
 protected:
  static constexpr double kCrossing_s = 3;

  static ScenePtr Scene() {
    SceneParams params;
    params.horizon = std::chrono::seconds(60);
    TestWorld world(params);
    world.Free({{-4, -4, -4}, {4, 4, 4}}).Occupied({{-1, 2, -1}, {1, 2.1, 1}});
    const Twist up{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY()};
    world.Given(1, Sphere{0.25}, Pose::Translation(0, -kCrossing_s, 0), up);
    return world.Scene();
  }
  // From x to x at y within so many seconds.
  static void AddEdge(double from_x_m, double until_x_m, double y_m, double lasts_s,
                      MotionBatch& edges) {
    edges.knot_counts.push_back(2);
    edges.times.insert(edges.times.end(), {Time(), Time() + FromSeconds(lasts_s)});
    edges.T_W_L.push_back(Pose::Translation(from_x_m, y_m, 0));
    edges.T_W_L.push_back(Pose::Translation(until_x_m, y_m, 0));
  }
  std::vector<std::vector<TimeInterval>> Find(const MotionBatch& edges, double until_s,
                                              double resolution_s = 0.05, double from_s = 0) {
    const auto dut = FindDepartureIntervals(counted_, edges, {TestTime(from_s), TestTime(until_s)},
                                            {{}, FromSeconds(resolution_s)});
    EXPECT_TRUE(dut.ok()) << dut.status();
    return dut.value_or(std::vector<std::vector<TimeInterval>>());
  }
  static double Seconds(Time t) { return ToSeconds(t - kTestStart); }

  SceneChecker checker_{Scene(), Robot::SingleShape("ball", Sphere{0.25})};
  Counted counted_{checker_};
};

TEST_F(DepartureIntervals, Empty) { EXPECT_TRUE(Find({}, 1).empty()); }

// Who departs c seconds after the one that meets the other at the origin is |c| / sqrt(2) m away
// from it at the closest.
TEST_F(DepartureIntervals, WhatCrossesAtConstantSpeedBlocksWhatTheClosedFormSays) {
  MotionBatch edges;
  AddEdge(-1, 1, 0, 2, edges);
  const double meets_s = kCrossing_s - 1, blocked_s = 0.5 * std::sqrt(2.0);
  for (const double resolution_s : {0.05, 0.01, 0.001}) {
    const auto dut = Find(edges, 6, resolution_s);
    ASSERT_EQ(dut.size(), 1u);
    ASSERT_EQ(dut[0].size(), 2u);
    EXPECT_EQ(dut[0][0].from, TestTime(0));
    EXPECT_EQ(dut[0][1].until, TestTime(6));
    const double until_s = Seconds(dut[0][0].until), from_s = Seconds(dut[0][1].from);
    EXPECT_LE(until_s, meets_s - blocked_s);
    EXPECT_GE(until_s, meets_s - blocked_s - 2 * resolution_s);
    EXPECT_GE(from_s, meets_s + blocked_s);
    EXPECT_LE(from_s, meets_s + blocked_s + 2 * resolution_s);
  }
}

// Who waits at the origin for a second must not be there while the other is.
TEST_F(DepartureIntervals, AWaitIsBlockedAsLongAsItMeetsWhatComesBy) {
  MotionBatch edges;
  AddEdge(0, 0, 0, 1, edges);
  const auto dut = Find(edges, 6);
  ASSERT_EQ(dut[0].size(), 2u);
  EXPECT_NEAR(Seconds(dut[0][0].until), kCrossing_s - 0.5 - 1, 0.05);
  EXPECT_NEAR(Seconds(dut[0][1].from), kCrossing_s + 0.5, 0.05);
}

TEST_F(DepartureIntervals, NeverBlockedIsTheWholeWindow) {
  MotionBatch edges;
  AddEdge(-1, 1, -2, 2, edges);
  const auto dut = Find(edges, 20, 0.05, 10);
  EXPECT_EQ(dut[0], (std::vector<TimeInterval>{{TestTime(10), TestTime(20)}}));
}

TEST_F(DepartureIntervals, WhatStandsStillBlocksAlwaysAndTakesOneProof) {
  MotionBatch edges;
  AddEdge(-2, 2, 2, 1, edges);
  EXPECT_TRUE(Find(edges, 60)[0].empty());
  EXPECT_EQ(counted_.asked, 1);
}

TEST_F(DepartureIntervals, OneDepartureIsAQuestionToo) {
  MotionBatch edges;
  AddEdge(-1, 1, 0, 2, edges);
  EXPECT_EQ(Find(edges, 1, 0.05, 1)[0], (std::vector<TimeInterval>{{TestTime(1), TestTime(1)}}));
  EXPECT_TRUE(Find(edges, 2, 0.05, 2)[0].empty());
}

TEST_F(DepartureIntervals, AllEdgesAreAskedAboutAtOnce) {
  MotionBatch edges;
  for (int i = 0; i < 100; ++i) AddEdge(-1, 1, -1 + 0.01 * i, 2, edges);
  EXPECT_EQ(Find(edges, 6).size(), 100u);
  EXPECT_LE(counted_.calls, 12);
  EXPECT_GT(counted_.asked, 1000);
}

TEST_F(DepartureIntervals, SaysWhatIsWrong) {
  MotionBatch edges;
  AddEdge(-1, 1, 0, 2, edges);
  const auto message = [&](MotionBatch batch, TimeInterval window, Duration resolution,
                           MotionOptions options = {}) {
    return FindDepartureIntervals(checker_, batch, window, {options, resolution})
        .status()
        .ToString();
  };
  const TimeInterval window{TestTime(0), TestTime(1)};
  const Duration step = FromSeconds(0.05);
  EXPECT_EQ(message(edges, window, step), "OK");
  const auto names = [](const std::string& dut, const std::string& field) {
    return dut.starts_with("INVALID_ARGUMENT: " + field + " ");
  };
  EXPECT_TRUE(names(message(edges, {TestTime(1), TestTime(0)}, step), "window.until_ns"));
  EXPECT_TRUE(names(message(edges, {Time::min(), TestTime(0)}, step), "window.from_ns"));
  EXPECT_TRUE(names(message(edges, window, Duration(0)), "resolution_ns"));
  EXPECT_TRUE(names(message(edges, window, Duration(9'000)), "window"));
  EXPECT_TRUE(names(message(edges, window, step, {{}, 0.01, Time()}), "world_at_ns"));
  EXPECT_TRUE(names(message(edges, window, step, {{}, 0}), "contact_resolution_m"));
  const Time last = TimeFromNanoseconds(kFarthest_ns);
  EXPECT_TRUE(
      names(message(edges, {Time(-last.time_since_epoch()), last}, step), "window.until_ns"));
  EXPECT_TRUE(names(message(edges, {last, last}, step), "window"));
  edges.knot_counts = {1};
  EXPECT_TRUE(names(message(edges, window, step), "knot_counts[0]"));
}

}  // namespace
}  // namespace clearway
