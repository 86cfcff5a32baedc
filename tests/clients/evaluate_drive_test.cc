// clearway evaluate on the real drive, where it is there.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "clients/run_clearway.h"
#include "support/data_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Poses of GPS drift, and what is parked seems to move with them: it is missed by 0.12 m a second
// ahead on poses that were made from the scans, and may be missed by twice that.
TEST(EvaluateDrive, RegistersScansOnPosesThatDriftUnlessToldOtherwise) {
  const auto folder = DataPath("kitti0000_fov");
  if (!folder) GTEST_SKIP() << "no recorded data";
  const auto parked_m = [&](std::vector<std::string> flags, const auto& truth) {
    flags.insert(flags.begin(), {"evaluate", *folder, "--poses", "oxts", "--motion", "track",
                                 "--rest-distance", "0.6", "--json"});
    const Finished dut = RunClearway(flags);
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
    const auto json = nlohmann::json::parse(dut.out);
    EXPECT_THAT(json["truth"].get<std::string>(), truth);
    for (const auto& object : json["objects"]) {
      if (object["id"] == 4) return object["prediction"][1]["median_m"].get<double>();
    }
    return std::numeric_limits<double>::quiet_NaN();
  };
  const auto registered = HasSubstr("scans are registered");
  EXPECT_LT(parked_m({}, registered), 0.24);
  EXPECT_LT(parked_m({"--sensor-error-deg", "1.15"}, registered), 0.24);
  EXPECT_GT(parked_m({"--sensor-error", "0"}, Not(registered)), 0.3);
}

}  // namespace
}  // namespace clearway
