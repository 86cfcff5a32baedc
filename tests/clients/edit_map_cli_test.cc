// clearway clear-region and keep-out against a real server.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"
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

TEST_F(CliServer, KeepOutBoxesWithoutAVolumeAreRefused) {
  const Finished dut = Clearway({"keep-out", "--add", "0,0,0,1,1,0"});
  EXPECT_EQ(dut.exit_code, 2);
  EXPECT_THAT(dut.err, HasSubstr("the box has no extent along z"));
}

TEST_F(CliServer, AnIgnoredObjectThatIsNotThereIsNoted) {
  Replay();
  const Finished dut = Clearway({"check", "--robot", "sphere:0.2", "--state", "0,0,1,0", "--ignore",
                                 "99", "--allow", "body:98", "--allow", "body:0"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.err, HasSubstr("note: --ignore: the scene has no object 99\n"));
  EXPECT_THAT(dut.err, HasSubstr("note: --allow: the scene has no object 98\n"));
  EXPECT_THAT(dut.err, Not(HasSubstr("object 0\n")));
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

TEST_F(CliServer, ClearingTellsHowManyVoxelsItCleared) {
  Replay();
  const json before = Ask({"occupancy", "--box", "0,-1,-1,2,1,1"})["times"][0];
  const std::uint64_t known =
      before["free"].get<std::uint64_t>() + before["occupied"].get<std::uint64_t>();
  const json dut = Ask({"clear-region", "0,-1,-1,2,1,1"});
  EXPECT_GT(known, 0u);
  EXPECT_GT(dut["voxels_cleared"], 0);
  EXPECT_LE(dut["voxels_cleared"].get<std::uint64_t>(), known);
  EXPECT_GE(dut["voxels_in_box"], dut["voxels_cleared"]);
  EXPECT_EQ(Ask({"clear-region", "0,-1,-1,2,1,1"})["voxels_cleared"], 0);
  EXPECT_THAT(Clearway({"clear-region", "0,-1,-1,2,1,1"}).out, HasSubstr("0 of "));
}

// The default server has voxels of 0.1 m.
TEST_F(CliServer, ABoxThatIsACenterClearsItsVoxelAndOneBetweenCentersNone) {
  Replay();
  const json known = Ask({"status"})["static_box_world"];
  ASSERT_TRUE(known.is_object()) << known;
  std::string centre;
  for (int i = 0; i < 3; ++i) {
    const double low = known["min_m"][static_cast<std::size_t>(i)];
    absl::StrAppend(&centre, i == 0 ? "" : ",", std::round(low * 10) / 10 + 0.05);
  }
  const json one = Ask({"clear-region", absl::StrCat(centre, ",", centre)});
  EXPECT_EQ(one["voxels_in_box"], 1);
  const Finished none = Clearway({"clear-region", "0.06,-1,-1,0.14,1,1"});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_THAT(none.out, HasSubstr("no voxel cleared from (0.06, "));
  EXPECT_THAT(none.err, HasSubstr("note: the box holds no centre of a voxel, so nothing is cleared;"
                                  " voxels of 0.1 m have centres at odd multiples of 0.05 m"));
  EXPECT_EQ(Ask({"clear-region", "0.06,-1,-1,0.14,1,1"})["voxels_in_box"], 0);
}

TEST_F(CliServer, ClearingWhatIsNotKnownIsNoted) {
  EXPECT_THAT(Clearway({"clear-region", kBox}).err, HasSubstr("the static map is empty"));
  Replay();
  const Finished dut = Clearway({"clear-region", kBox});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.err, HasSubstr("no observed voxel in the box; it spans ("));
  const Finished beyond = Clearway({"clear-region", "9e5,9e5,9e5,9.1e5,9.1e5,9.1e5"});
  EXPECT_THAT(beyond.err, HasSubstr("no observed voxel in the box; it spans ("));
  EXPECT_THAT(beyond.err, Not(HasSubstr("centre of a voxel")));
}

}  // namespace
}  // namespace clearway
