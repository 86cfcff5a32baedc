// Frames that cannot be read: commands stop there, or leave them out with --keep-going.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "clients/cli_server.h"
#include "io/lidar_example.h"
#include "io/pcd_example.h"
#include "io/recording_example.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// Three frames, 4 to 6, of which the second's points are cut off.
std::string WriteCutExample(const TemporaryFolder& folder) {
  WriteExample(folder);
  folder.Write("points/0005.bin", "cut off");
  return folder.path();
}

TEST_F(CliServer, ReplayThatStopsSaysHowFarItCame) {
  const TemporaryFolder folder;
  const Finished dut = Clearway({"replay", WriteCutExample(folder)});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("stopped at frame 1 of 3 (counted from 0); 1 frame was sent"));
  EXPECT_THAT(dut.err, HasSubstr("0005.bin: 7 bytes are not a whole number"));
  EXPECT_EQ(Ask({"status"})["frames_applied"], 1);
}

TEST_F(CliServer, ReplayThatKeepsGoingLeavesOutWhatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string path = WriteCutExample(folder);
  const Finished dut = Clearway({"replay", path, "--keep-going", "--json"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("1 frame of the input is left out"));
  EXPECT_THAT(dut.err, HasSubstr("1 frame could not be read, the first: frame 1"));
  const json summary = json::parse(dut.out);
  EXPECT_EQ(summary["applied"], 2);
  EXPECT_EQ(summary["left_out"]["frames"], 1);
  EXPECT_THAT(summary["left_out"]["reasons"].dump(), HasSubstr("(frame 1, counted from 0)"));
  EXPECT_EQ(summary["reports"]["objects_restarted"], 0);
}

// Frames that cannot be read stop no replay of others.
TEST_F(CliServer, RangesInSecondsPassOverWhatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string path = WriteCutExample(folder);
  for (const auto& [flag, seconds] : {std::pair("--to", "0.05s"), {"--from", "0.2s"}}) {
    const Finished dut = Clearway({"replay", path, flag, seconds, "--json"});
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
    EXPECT_EQ(json::parse(dut.out)["applied"], 1);
  }
}

TEST(KeepGoing, RecordLeavesOutWhatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string path = WriteCutExample(folder), out = folder / "drive.cwr";
  const Finished stopped = RunClearway({"record", path, "--out", out});
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_THAT(stopped.err, HasSubstr("stopped at frame 1 of 3 (counted from 0); --keep-going"));
  EXPECT_FALSE(std::filesystem::exists(out));
  const Finished dut = RunClearway({"record", path, "--out", out, "--keep-going", "--json"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("1 frame could not be read, the first: frame 1"));
  EXPECT_THAT(dut.err, HasSubstr("3/3 frames"));  // there are no more to come
  EXPECT_EQ(json::parse(dut.out)["frames"], 2);
  EXPECT_EQ(json::parse(dut.out)["left_out"]["frames"], 1);
  EXPECT_EQ(json::parse(RunClearway({"info", out, "--json"}).out)["frames"], 2);
}

// Twice over the frames, which counts what is left out once.
TEST(KeepGoing, EvaluateLeavesOutWhatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string path = WriteCutExample(folder);
  const Finished stopped = RunClearway({"evaluate", path});
  EXPECT_EQ(stopped.exit_code, 1);
  EXPECT_THAT(stopped.err, HasSubstr("stopped at frame 1 of 3 (counted from 0); --keep-going"));
  for (const char* error_m : {"0", "1"}) {
    const Finished dut =
        RunClearway({"evaluate", path, "--keep-going", "--json", "--sensor-error", error_m});
    EXPECT_EQ(dut.exit_code, 1);
    EXPECT_THAT(dut.err, HasSubstr("1 frame of the input is left out"));
    EXPECT_EQ(json::parse(dut.out)["frames"], 2);
  }
}

TEST(KeepGoing, EvaluateLeavesOutDamagedFramesOfARecording) {
  const TemporaryFolder folder;
  const std::string recording = folder / "drive.cwr", page = folder / "page.html";
  RunClearway({"simulate", "small", "--out", recording, "--frames", "12", "--objects", "poses"});
  ChangeDatabase(recording, "UPDATE frame SET stamp_ns = stamp_ns + 1 WHERE number = 3");
  EXPECT_EQ(RunClearway({"evaluate", recording}).exit_code, 1);
  EXPECT_EQ(RunClearway({"evaluate", recording, "--from", "5"}).exit_code, 0);
  const Finished dut =
      RunClearway({"evaluate", recording, "--keep-going", "--json", "--html", page});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("1 frame could not be read, the first: frame 3"));
  EXPECT_EQ(json::parse(dut.out)["frames"], 11);
  EXPECT_THAT(BytesOf(page), HasSubstr("1 frame of the input is left out"));
}

TEST(KeepGoing, InfoNamesWhatCannotBeRead) {
  const TemporaryFolder folder;
  const Finished dut = RunClearway({"info", WriteCutExample(folder), "--json"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  const json info = json::parse(dut.out);
  EXPECT_EQ(info["frames"], 3);
  EXPECT_THAT(info["left_out"]["reasons"].dump(), HasSubstr("(frame 1, counted from 0)"));
}

// The reader takes the field names from the first cloud that it can read.
TEST(KeepGoing, TheFirstCloudMayBeCutOff) {
  const TemporaryFolder folder;
  for (const char* name : {"0.pcd", "1.pcd"}) folder.Write(name, AsciiPcd({{5, 1, 0, 0, 0}}));
  folder.Write("poses.txt", "1.0 0 0 0 0 0 0 1\n1.1 0 0 0 0 0 0 1\n");
  const std::string out = folder / "drive.cwr";
  EXPECT_EQ(RunClearway({"record", folder.path(), "--out", out}).exit_code, 0);
  folder.Write("0.pcd", "");
  const Finished dut =
      RunClearway({"record", folder.path(), "--out", out, "--force", "--keep-going", "--json"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_EQ(json::parse(dut.out)["frames"], 1) << dut.err;
}

TEST(KeepGoing, NothingComesOfFramesOfWhichNoneCanBeRead) {
  const TemporaryFolder folder;
  const std::string path = WriteCutExample(folder), out = folder / "drive.cwr";
  for (const char* name : {"points/0004.bin", "points/0006.bin"}) folder.Write(name, "cut off");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"evaluate", path}, {"record", path, "--out", out}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--keep-going", "--json"});
    const Finished dut = RunClearway(arguments);
    EXPECT_EQ(dut.exit_code, 1);
    EXPECT_THAT(dut.err, HasSubstr("3 frames could not be read, the first: frame 0"));
    EXPECT_EQ(dut.out, "");
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace clearway
