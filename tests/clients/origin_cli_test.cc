// --origin: worlds in UTM coordinates on the command line and on a server.
#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "clients/cli_server.h"
#include "clients/utm_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class OriginCli : public CliServer {
 protected:
  void SetUp() override {
    CliServer::SetUp();
    WriteUtmFolder(folder_);
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_.path().string();
};

TEST_F(OriginCli, WithoutOneTheErrorSaysSo) {
  for (const char* command : {"info", "replay", "evaluate"}) {
    const Finished dut = command == std::string("replay") ? Clearway({command, path_})
                                                          : RunClearway({command, path_});
    EXPECT_EQ(dut.exit_code, 1) << command;
    EXPECT_THAT(dut.err, HasSubstr("the sensor is at 500000.25,4100000.5,1.5, beyond the limit of "
                                   "100000 m from the origin of the world; --origin first"));
  }
}

TEST_F(OriginCli, InfoShowsIt) {
  const Finished dut = RunClearway({"info", path_, "--origin", "first"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.out, HasSubstr("origin      500000.25,4100000.5,1.5, subtracted"));
  const Finished as_json = RunClearway({"info", path_, "--origin", "500000,4100000,0", "--json"});
  EXPECT_EQ(json::parse(as_json.out)["origin_m"], json({500000, 4100000, 0}));
}

TEST_F(OriginCli, EvaluateComparesInTheMovedWorld) {
  const Finished dut = RunClearway({"evaluate", path_, "--origin", "first", "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const json found = json::parse(dut.out);
  ASSERT_EQ(found["objects"].size(), 1u);
  EXPECT_THAT(found["source"].get<std::string>(), HasSubstr("origin 500000.25,4100000.5,1.5"));
}

TEST_F(OriginCli, ReplaySubtractsItAndExportAddsItAgain) {
  const Finished sent = Clearway({"replay", path_, "--origin", "500000,4100000,0"});
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_THAT(sent.err, HasSubstr("the origin 500000,4100000,0 is subtracted"));
  const json object = Ask({"objects"})["objects"][0];
  EXPECT_NEAR(object["box_world"]["min_m"][0].get<double>(), 12.25, 0.5);
  EXPECT_NEAR(object["box_world"]["min_m"][1].get<double>(), 3.5, 0.5);

  const std::string map = folder_ / "map.ply";
  const json written = Ask({"export", "--out", map, "--origin", "500000,4100000,0"});
  EXPECT_EQ(written["origin_m"], json({500000, 4100000, 0}));
  const std::string ply = BytesOf(map);
  EXPECT_EQ(written["bytes"], ply.size());
  EXPECT_THAT(ply, HasSubstr("comment origin 500000,4100000,0 added"));
  EXPECT_THAT(ply, HasSubstr("property double x"));
  double p[3];
  std::memcpy(p, ply.data() + ply.find("end_header\n") + 11, sizeof p);
  // The static point of the first frame: 5, 2, -1.5 before the sensor.
  EXPECT_NEAR(p[0], 500'005.25, 3.1);
  EXPECT_NEAR(p[1], 4'100'002.5, 0.1);
  EXPECT_NEAR(p[2], 0, 0.1);
}

TEST_F(OriginCli, ExportRefusesItWhereItMakesNoSense) {
  for (const std::vector<std::string>& flags :
       std::vector<std::vector<std::string>>{{"--out", "m.bt"},
                                             {"--out", "m.ply", "--what", "object:7"},
                                             {"--out", "m.ply", "--origin", "first"}}) {
    std::vector<std::string> arguments = {"export", "--origin", "1,2,3"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    const Finished dut = Clearway(arguments);
    EXPECT_EQ(dut.exit_code, 2) << flags[1];
    EXPECT_THAT(dut.err, HasSubstr("--origin"));
  }
}

TEST_F(OriginCli, ARecordingKeepsIt) {
  const std::string file = folder_ / "utm.cwr";
  const Finished written = RunClearway({"record", path_, "--origin", "first", "--objects", "poses",
                                        "--from", "1", "--out", file, "--json"});
  ASSERT_EQ(written.exit_code, 0) << written.err;
  EXPECT_EQ(json::parse(written.out)["frames"], 3);
  EXPECT_EQ(json::parse(written.out)["origin_m"], json({500000.25, 4100000.5, 1.5}));
  const Finished info = RunClearway({"info", file});
  EXPECT_THAT(info.out, HasSubstr("origin      500000.25,4100000.5,1.5, subtracted"));
  const Finished moved = RunClearway({"info", file, "--origin", "first", "--json"});
  EXPECT_EQ(json::parse(moved.out)["origin_m"], json({500001.25, 4100000.5, 1.5}));
  const json sent = Ask({"replay", file});
  EXPECT_EQ(sent["applied"], 3);
  EXPECT_EQ(sent["origin_m"], json({500000.25, 4100000.5, 1.5}));
  EXPECT_EQ(RunClearway({"record", path_, "--origin", "first", "--out", file}).exit_code, 1);
  EXPECT_EQ(RunClearway({"evaluate", file}).exit_code, 0);
}

TEST(Origin, IsRefusedWhereItMakesNoSense) {
  for (const char* text : {"last", "1,2", "1,2,nan", "1,2,1e9", ""}) {
    const Finished dut = RunClearway({"info", "nowhere", "--origin", text});
    EXPECT_EQ(dut.exit_code, 2) << text;
    EXPECT_THAT(dut.err, HasSubstr("--origin"));
  }
  const Finished dut = RunClearway({"info", "sim:small", "--origin", "first"});
  EXPECT_EQ(dut.exit_code, 2);
  EXPECT_THAT(dut.err, HasSubstr("sim:small is a simulation"));
}

}  // namespace
}  // namespace clearway
