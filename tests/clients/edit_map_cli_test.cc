// clearway clear-region and keep-out against a real server.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "clients/cli_server.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kBox[] = "1000,1000,1000,1001,1002,1003";
constexpr char kInside[] = "1000.5,1001,1001";

TEST_F(CliServer, KeepOutBoxesAreAddedListedAndCleared) {
  EXPECT_EQ(Ask({"keep-out"})["boxes_world"], json::array());
  const json one = Ask({"keep-out", "--add", kBox});
  ASSERT_EQ(one["boxes_world"].size(), 1u);
  EXPECT_EQ(one["boxes_world"][0]["min_m"], json({1000, 1000, 1000}));
  EXPECT_EQ(one["boxes_world"][0]["max_m"], json({1001, 1002, 1003}));
  EXPECT_GT(one["version"], 0);
  EXPECT_EQ(Ask({"keep-out", "--add", "-2,-2,-2,-1,-1,-1"})["boxes_world"].size(), 2u);
  EXPECT_EQ(Ask({"keep-out"})["boxes_world"].size(), 2u);
  EXPECT_THAT(Clearway({"keep-out"}).out, HasSubstr("(-2.00, -2.00, -2.00)"));
  const json replaced = Ask({"keep-out", "--clear", "--add", "0,0,0,1,1,1"})["boxes_world"];
  ASSERT_EQ(replaced.size(), 1u);
  EXPECT_EQ(replaced[0]["max_m"], json({1, 1, 1}));
  EXPECT_EQ(Ask({"keep-out", "--clear"})["boxes_world"], json::array());
  EXPECT_EQ(Ask({"keep-out"})["boxes_world"], json::array());
}

TEST_F(CliServer, AKeepOutBoxIsOccupiedUntilItIsCleared) {
  Replay();
  const auto status = [&] { return Ask({"occupancy", "--at", kInside})["points"][0]["status"]; };
  EXPECT_EQ(status(), "UNKNOWN_SPACE");
  Ask({"keep-out", "--add", kBox});
  EXPECT_EQ(status(), "OCCUPIED");
  Ask({"keep-out", "--clear"});
  EXPECT_EQ(status(), "UNKNOWN_SPACE");
}

TEST_F(CliServer, AClearedRegionIsUnknown) {
  Replay();
  const auto counts = [&] { return Ask({"occupancy", "--box", "0,-1,-1,2,1,1"})["times"][0]; };
  ASSERT_GT(counts()["free"], 0);
  const Finished dut = Clearway({"clear-region", "0,-1,-1,2,1,1"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.out, HasSubstr("is unknown from (0.00, -1.00, -1.00)"));
  EXPECT_THAT(dut.err, Not(HasSubstr("note")));
  EXPECT_EQ(counts()["free"], 0);
  EXPECT_EQ(Ask({"clear-region", "-1,-1,-1,2,1,1"})["box_world"]["min_m"], json({-1, -1, -1}));
}

TEST_F(CliServer, ClearingWhatIsNotKnownIsNoted) {
  EXPECT_THAT(Clearway({"clear-region", kBox}).err, HasSubstr("the static map is empty"));
  Replay();
  const Finished dut = Clearway({"clear-region", kBox});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.err, HasSubstr("no observed voxel in the box; it spans ("));
}

}  // namespace
}  // namespace clearway
