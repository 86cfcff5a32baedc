// The worlds `swaps` and `far_swaps`: one goes out of sight for good, and another comes out in its
// place.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "clearway/sim/scenarios.h"

namespace clearway {
namespace {

constexpr std::uint64_t kAllPairs = 20;

// By the objects that are seen, in which frames; with fewer rays than at full size.
std::map<ObjectId, std::set<std::size_t>> SeenIn(const Simulation& simulation) {
  std::map<ObjectId, std::set<std::size_t>> seen;
  for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
    for (const ObjectId label : simulation.MakeFrame(k).labels) {
      if (label > kStaticLabel) seen[label].insert(k);
    }
  }
  return seen;
}

Simulation World(const std::string& name, std::uint64_t seed) {
  return MakeScenario(name, {.seed = seed, .beams = 16, .azimuth_steps = 500}).value();
}

class SwapsTest : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(NearAndFar, SwapsTest, testing::Values("swaps", "far_swaps"),
                         [](const auto& name) { return name.param; });

TEST_P(SwapsTest, AnotherOneComesOutWhenAndWhereTheFirstWould) {
  for (std::uint64_t seed = 1; seed <= kAllPairs; ++seed) {
    const Simulation dut = World(GetParam(), seed);
    const auto seen = SeenIn(dut);
    const std::size_t lost = *seen.at(1).rbegin(), young = *seen.at(2).begin();
    EXPECT_GE(seen.at(1).size(), 10u) << seed;
    EXPECT_GE(seen.at(2).size(), 10u) << seed;
    ASSERT_GT(young, lost) << seed;
    EXPECT_LE(young - lost, 30u) << seed;  // 0.1 s each
    const auto place = [&](ObjectId id, std::size_t k) {
      return dut.world().T_W_B(id, dut.StampOf(k))->translation;
    };
    const Eigen::Vector3d step_W = place(1, lost - 5) - place(1, lost - 6);
    const Eigen::Vector3d would_be_W =
        place(1, lost - 5) + (static_cast<double>(young - lost) + 5) * step_W;
    EXPECT_LT((would_be_W - place(2, young)).head<2>().norm(), 0.01) << seed;
    EXPECT_NE(dut.world().FindObject(1)->name, dut.world().FindObject(2)->name) << seed;
  }
}

TEST_P(SwapsTest, OnTheOtherSideTheSameOneComesOut) {
  for (std::uint64_t seed = 1; seed <= kAllPairs; ++seed) {
    const Simulation dut = World(GetParam(), seed);
    const auto seen = SeenIn(dut);
    EXPECT_EQ(seen.size(), 3u) << seed;
    const std::set<std::size_t>& frames = seen.at(3);
    EXPECT_LT(frames.size(), *frames.rbegin() - *frames.begin() + 1) << seed;  // hidden in between
    EXPECT_EQ(dut.world().FindObject(3)->name, dut.world().FindObject(1)->name) << seed;
  }
}

// Nothing but their distance is another.
TEST(FarSwapsTest, AreTwentyMetresFartherOff) {
  for (std::uint64_t seed = 1; seed <= kAllPairs; ++seed) {
    const Simulation near = World("swaps", seed), far = World("far_swaps", seed);
    for (const ObjectId id : {1, 2, 3}) {
      const Body &near_body = *near.world().FindObject(id), &far_body = *far.world().FindObject(id);
      EXPECT_EQ(near_body.name, far_body.name) << seed;
      const auto y_m = [&](const Simulation& simulation) {
        for (std::size_t k = 0; k < simulation.frame_count(); ++k) {
          const auto T_W_B = simulation.world().T_W_B(id, simulation.StampOf(k));
          if (T_W_B) return std::abs(T_W_B->translation.y());
        }
        return 0.0;
      };
      EXPECT_NEAR(y_m(far) - y_m(near), 20, 1e-9) << seed;
    }
  }
}

}  // namespace
}  // namespace clearway
