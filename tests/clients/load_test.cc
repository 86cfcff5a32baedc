// Load and its random questions, without a server.
#include "load/load.h"

#include <gmock/gmock.h>

#include <atomic>

#include "load/questions.h"

namespace clearway {
namespace {

QuestionSpace Space() {
  QuestionSpace space;
  space.box_W = {{-1, 2, 0}, {3, 4, 0.5}};
  space.from = TimeFromNanoseconds(7'000'000'000);
  space.span = std::chrono::seconds(1);
  return space;
}

TEST(Load, Empty) {
  const auto report = RunLoad({}, Duration(1));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->calls(), 0u);
  EXPECT_EQ(report->CallsPerSecond(), 0);
  EXPECT_EQ(report->LatencyMs(0.99), 0);
}

TEST(Load, CountsEveryCallButTheFirst) {
  std::atomic<int> calls = 0;
  const LoadCall caller = [&] {
    ++calls;
    return absl::OkStatus();
  };
  const auto report = RunLoad({caller, caller, caller}, std::chrono::milliseconds(1));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(static_cast<int>(report->calls()) + 3, calls);
  EXPECT_TRUE(std::is_sorted(report->latencies_ms.begin(), report->latencies_ms.end()));
}

TEST(Load, LatenciesAreThoseOfCalls) {
  LoadReport dut;
  for (int i = 1; i <= 200; ++i) dut.latencies_ms.push_back(i);
  EXPECT_EQ(dut.LatencyMs(0), 1);
  EXPECT_EQ(dut.LatencyMs(0.5), 100);
  EXPECT_EQ(dut.LatencyMs(0.99), 198);
  EXPECT_EQ(dut.LatencyMs(1), 200);
}

TEST(Load, EndsWithTheFirstError) {
  const LoadCall fine = [] { return absl::OkStatus(); };
  const LoadCall bad = [n = 0]() mutable {
    return ++n < 3 ? absl::OkStatus() : absl::NotFoundError("gone");
  };
  const auto report = RunLoad({fine, bad}, std::chrono::hours(1));
  EXPECT_EQ(report.status(), absl::NotFoundError("gone"));
}

TEST(RandomQuestions, PointsFillTheBox) {
  Aabb box_W;
  for (const Eigen::Vector3f& p_W : RandomQuestions(Space(), 1).Points(1000)) {
    EXPECT_TRUE(Space().box_W.Contains(p_W.cast<double>()));
    box_W.Extend(p_W.cast<double>());
  }
  EXPECT_TRUE((box_W.Size().array() > 0.9 * Space().box_W.Size().array()).all());
}

TEST(RandomQuestions, TimesComeInSteps) {
  std::set<Time> times;
  for (Time time : RandomQuestions(Space(), 1).Times(1000)) times.insert(time);
  EXPECT_EQ(times.size(), 11u);
  EXPECT_EQ(*times.begin(), Space().from);
  EXPECT_EQ(*times.rbegin(), Space().from + Space().span);
}

TEST(RandomQuestions, WithoutAStepAnyTime) {
  QuestionSpace space = Space();
  space.step = Duration(0);
  std::set<Time> times;
  for (Time time : RandomQuestions(space, 1).Times(1000)) times.insert(time);
  EXPECT_GT(times.size(), 990u);
  EXPECT_LE(*times.rbegin(), space.from + space.span);
}

TEST(RandomQuestions, LinksKeepTheirPlaceOnTheRobot) {
  const std::vector<Pose> T_R_L = {Pose{}, Pose::Translation(0, 0, 1)};
  const StateBatch states = RandomQuestions(Space(), 1).States(20, T_R_L);
  ASSERT_EQ(states.times.size(), 20u);
  ASSERT_EQ(states.T_W_L.size(), 40u);
  for (std::size_t s = 0; s < 20; ++s) {
    const Pose T_L0_L1 = Inverse(states.T_W_L[2 * s]) * states.T_W_L[2 * s + 1];
    EXPECT_TRUE(T_L0_L1.translation.isApprox(Eigen::Vector3d(0, 0, 1)));
  }
}

TEST(RandomQuestions, TheSeedFixesThem) {
  RandomQuestions a(Space(), 5), b(Space(), 5), c(Space(), 6);
  EXPECT_EQ(a.Points(3), b.Points(3));
  EXPECT_NE(b.Points(3), c.Points(3));
}

}  // namespace
}  // namespace clearway
