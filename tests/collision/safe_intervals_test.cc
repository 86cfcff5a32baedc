// Safe intervals against looks at many times.
#include "clearway/collision/safe_intervals.h"

#include <gtest/gtest.h>

#include "clearway/collision/scene_checker.h"
#include "collision/random_motions.h"
#include "collision/random_world.h"

namespace clearway {
namespace {

constexpr double kLook_s = 0.05;

TEST(SafeIntervals, AreFreeThroughoutAndMissLittle) {
  int intervals = 0, beginning_late = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    RandomWorld random(4000 + seed);
    const ScenePtr scene = random.Scene();
    const SceneChecker checker(scene, random.AnyRobot());
    const StateBatch places = random.States(checker.robot(), 10);
    const CheckOptions options = RandomMotionOptions(random, checker.robot()).check;
    const TimeInterval window{scene->stamp, scene->stamp + FromSeconds(4)};
    const auto dut = FindSafeIntervals(checker, places.T_W_L, window, {.check = options});
    ASSERT_TRUE(dut.ok()) << dut.status();
    ASSERT_EQ(dut->size(), 10u);
    const std::size_t links = checker.robot().links.size();
    for (std::size_t c = 0; c < dut->size(); ++c) {
      StateBatch states;
      for (int i = 0; i <= 1000; ++i) {
        states.times.push_back(window.from + FromSeconds(0.004 * i));
        states.T_W_L.insert(states.T_W_L.end(), &places.T_W_L[c * links],
                            &places.T_W_L[c * links] + links);
      }
      const auto truth = checker.Check(states, options);
      int free_outside = 0;
      for (int i = 0; i <= 1000; ++i) {
        const Time t = states.times[i];
        const bool safe = std::ranges::any_of((*dut)[c], [&](const TimeInterval& interval) {
          return interval.from <= t && t < interval.until;
        });
        const bool free = truth->answers[i].status == SpaceStatus::kFree;
        ASSERT_TRUE(free || !safe) << "seed " << seed << ", configuration " << c;
        free_outside += free && !safe;
      }
      const int looks_late = static_cast<int>(kLook_s / 0.004) + 1;
      beginning_late += free_outside > 2 * looks_late * (static_cast<int>((*dut)[c].size()) + 1);
      intervals += static_cast<int>((*dut)[c].size());
      for (std::size_t i = 1; i < (*dut)[c].size(); ++i) {
        EXPECT_GT((*dut)[c][i].from, (*dut)[c][i - 1].until);
      }
    }
  }
  EXPECT_GT(intervals, 100);
  EXPECT_LT(beginning_late, 8);  // of 400: unresolved
}

TEST(SafeIntervals, SaysWhatIsWrong) {
  RandomWorld random(1);
  const SceneChecker checker(random.Scene(), Robot::SingleShape("one", Sphere{0.1}));
  const auto message = [&](TimeInterval window, Duration look_every, std::size_t poses) {
    return FindSafeIntervals(checker, std::vector<Pose>(poses), window, {{}, look_every})
        .status()
        .ToString();
  };
  const Time now;
  const Duration look = FromSeconds(kLook_s);
  EXPECT_NE(message({now, now - look}, look, 1).find("window.until"), std::string::npos);
  EXPECT_NE(message({now, now + look}, Duration(0), 1).find("look_every"), std::string::npos);
  EXPECT_NE(message({now, now + FromSeconds(1e6)}, look, 1).find("100000"), std::string::npos);
  const Time last = TimeFromNanoseconds(kFarthest_ns);
  EXPECT_NE(message({Time::min(), now}, look, 1).find("window.from_ns"), std::string::npos);
  EXPECT_NE(message({now, Time::max()}, look, 1).find("window.until_ns"), std::string::npos);
  EXPECT_NE(message({Time(-last.time_since_epoch()), last}, look, 1).find("window.until_ns"),
            std::string::npos);
  EXPECT_EQ(message({now, now}, look, 0), "OK");
  EXPECT_EQ(message({now, now + look}, Duration::max(), 1), "OK");
}

}  // namespace
}  // namespace clearway
