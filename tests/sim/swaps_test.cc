// The world `swaps`: one goes out of sight for good, and another comes out in its place.
#include <gtest/gtest.h>

#include <map>
#include <set>

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

Simulation World(std::uint64_t seed) {
  return MakeScenario("swaps", {.seed = seed, .beams = 16, .azimuth_steps = 500}).value();
}

TEST(SwapsTest, AnotherOneComesOutWhenAndWhereTheFirstWould) {
  for (std::uint64_t seed = 1; seed <= kAllPairs; ++seed) {
    const Simulation dut = World(seed);
    const auto seen = SeenIn(dut);
    const std::size_t lost = *seen.at(1).rbegin(), young = *seen.at(2).begin();
    EXPECT_GE(seen.at(1).size(), 10u) << seed;
    EXPECT_GE(seen.at(2).size(), 10u) << seed;
    ASSERT_GT(young, lost) << seed;
    EXPECT_LE(young - lost, 25u) << seed;  // 0.1 s each
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

TEST(SwapsTest, OnTheOtherSideTheSameOneComesOut) {
  for (std::uint64_t seed = 1; seed <= kAllPairs; ++seed) {
    const Simulation dut = World(seed);
    const auto seen = SeenIn(dut);
    EXPECT_EQ(seen.size(), 3u) << seed;
    const std::set<std::size_t>& frames = seen.at(3);
    EXPECT_LT(frames.size(), *frames.rbegin() - *frames.begin() + 1) << seed;  // hidden in between
    EXPECT_EQ(dut.world().FindObject(3)->name, dut.world().FindObject(1)->name) << seed;
  }
}

}  // namespace
}  // namespace clearway
