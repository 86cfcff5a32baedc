// clearway evaluate tells who is known again under another id, and whether rightly.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/run_clearway.h"

namespace clearway {
namespace {

nlohmann::json Identities(const std::string& world, int seed, std::vector<std::string> flags) {
  flags.insert(flags.begin(), {"evaluate", "sim:" + world, "--seed", std::to_string(seed),
                               "--forget", "0.5", "--motion", "track", "--json"});
  return nlohmann::json::parse(RunClearway(flags).out)["identities"];
}

TEST(EvaluateIdentities, WhatIsKnownAgain) {
  const auto without = Identities("occlusions", 5, {"--frames", "60"});
  const auto with = Identities("occlusions", 5, {"--frames", "60", "--reidentify"});
  EXPECT_GE(without["came_back"], 3);
  EXPECT_EQ(without["known_again"], 0);
  EXPECT_EQ(with["came_back"], without["came_back"]);
  EXPECT_EQ(with["known_again"], with["came_back"]);
  EXPECT_EQ(with["wrong"], 0);
}

// One is lost, another one comes out in its place and the lost one elsewhere.
class SwappedTest : public testing::Test {
 protected:
  static void ExpectRight(const std::string& world, int seed) {
    const auto dut = Identities(world, seed, {"--reidentify"});
    EXPECT_EQ(dut["known_again"], 1) << world << " " << seed;
    EXPECT_EQ(dut["wrong"], 0) << world << " " << seed;
  }
};

// A child for a pedestrian, where beams are two voxels apart: what is doubted in most scans is not
// joined because the last one shows less to doubt.
TEST_F(SwappedTest, FarOff) { ExpectRight("far_swaps", 60); }

// A motorcyclist for a cyclist: at first little tells them apart, after a second much.
TEST_F(SwappedTest, OfNearlyOneShape) {
  for (const int seed : {211, 251, 411, 571, 611}) ExpectRight("swaps", seed);
}

}  // namespace
}  // namespace clearway
