// clearway replay against a real server.
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "clients/cli_server.h"
#include "io/lidar_example.h"
#include "io/recording_example.h"
#include "support/eventually.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using testing_support::Eventually;

TEST_F(CliServer, ReplayOfOneRunIsAppliedOnce) {
  const std::vector<std::string> replay = {"replay",  "sim:small",    "--frames", "8",
                                           "--quiet", "--sensor-run", "7"};
  const json first = Ask(replay);
  EXPECT_EQ(first["frames"], kFrames);
  EXPECT_EQ(first["applied"], kFrames);
  EXPECT_EQ(first["repeated"], 0);
  const json status = Ask({"status"});
  EXPECT_EQ(status["frames_applied"], kFrames);
  EXPECT_EQ(status["version"], first["version"]);
  EXPECT_EQ(Ask(replay)["repeated"], kFrames);
  EXPECT_EQ(Clearway({"replay", "sim:small", "--sensor-run", "-1"}).exit_code, 2);
}

// Each replay is a run of its own: the second one starts over, which only a reset allows.
TEST_F(CliServer, ASecondReplayIsRefusedAndSaysWhy) {
  Replay();
  const Finished dut = Clearway({"replay", "sim:small", "--frames", "8"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("before the newest frame of the same sensor"));
  EXPECT_THAT(dut.err, HasSubstr("reset"));
  // The last frame, sent before the first one's answer came, is as new as the newest.
  EXPECT_LE(Ask({"status"})["frames_applied"], kFrames + 1);
  Ask({"reset"});
  EXPECT_EQ(Replay()["applied"], kFrames);
}

Frame OfSensor(const std::string& sensor, std::uint64_t sequence, double seconds) {
  Frame frame;
  frame.sensor_id = sensor;
  frame.sequence = sequence;
  frame.stamp = Time(FromSeconds(seconds));
  frame.points_S = {{5, 0, 0.5F}};
  frame.labels = {kStaticLabel};
  return frame;
}

std::string Recorded(const TemporaryFolder& folder, const std::vector<Frame>& frames) {
  WriteFrames(folder / "frames.cwr", frames);
  return folder / "frames.cwr";
}

TEST_F(CliServer, ReplayOfTwoInterleavedSensors) {
  std::vector<Frame> frames;
  for (std::uint64_t k = 0; k < 5; ++k) {
    const double front_s = 1 + 0.1 * static_cast<double>(k);
    frames.push_back(OfSensor("front", k, front_s));
    frames.push_back(OfSensor("rear", k, front_s - 0.01));
  }
  const TemporaryFolder folder;
  const std::string file = Recorded(folder, frames);
  const json dut = Ask({"replay", file, "--quiet"});
  EXPECT_EQ(dut["applied"], 10);
  EXPECT_EQ(dut["late"], 5);
  EXPECT_EQ(dut["stamp_ns"], 1'400'000'000);
  EXPECT_EQ(Ask({"status"})["frames_late"], 5);
  Ask({"reset"});
  EXPECT_THAT(
      Clearway({"replay", file}).out,
      HasSubstr("5 frames of a sensor arrived after newer ones of another, by up to 0.01 s"));
}

// The sensor counts from 0 again; its run tells one start from the other.
TEST_F(CliServer, ReplayOfASensorThatRestarted) {
  std::vector<Frame> frames;
  for (std::uint64_t k = 0; k < 4; ++k) {
    frames.push_back(OfSensor("cam", k % 2, 1 + 0.1 * static_cast<double>(k)));
    frames.back().sensor_run = k / 2;
  }
  const TemporaryFolder folder;
  EXPECT_EQ(Ask({"replay", Recorded(folder, frames), "--quiet"})["applied"], 4);
}

TEST_F(CliServer, ReplayOfAClockThatJumps) {
  const TemporaryFolder folder;
  const std::string file = Recorded(
      folder, {OfSensor("cam", 0, 1), OfSensor("cam", 1, 1e5), OfSensor("cam", 2, 1e5 + 1)});
  const Finished refused = Clearway({"replay", file});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("frame 1 of cam was refused"));
  EXPECT_THAT(refused.err, HasSubstr("allow_stamp_jump"));
  Ask({"reset"});
  EXPECT_EQ(Ask({"replay", file, "--quiet", "--allow-stamp-jump"})["applied"], 3);
}

TEST_F(CliServer, ReplayAcrossARestartOfTheServerSaysWhatIsLost) {
  const std::string address = server_->address();
  Finished dut;
  std::thread replay([&] {
    dut = Clearway({"replay", "sim:small", "--frames", "20", "--rate", "0.5", "--json"});
  });
  EXPECT_TRUE(Eventually([&] { return Ask({"status"})["frames_applied"] >= 3; }));
  server_.reset();
  server_ = std::make_unique<ServerProcess>(std::vector<std::string>{}, address);
  replay.join();
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("warning: connected to " + address + " again, but the server"));
  const json summary = json::parse(dut.out);
  const std::size_t lost = summary["lost"];
  EXPECT_GE(lost, 3u);
  EXPECT_THAT(dut.err, HasSubstr(absl::StrCat("lacks the first ", lost, " frames")));
  EXPECT_EQ(summary["applied"], 20);
  const json status = Ask({"status"});
  EXPECT_EQ(status["frames_applied"], 20 - lost);
  EXPECT_EQ(status["version"], summary["version"]);
}

TEST_F(CliServer, ReplayShowsItsProgress) {
  const Finished dut = Clearway({"replay", "sim:small", "--frames", "4"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
  EXPECT_THAT(dut.err, HasSubstr("4/4 frames"));
  EXPECT_THAT(dut.err, HasSubstr("points/s"));
  EXPECT_THAT(dut.out, StartsWith("sent 4 frames"));
}

TEST_F(CliServer, ReplayTakesARange) {
  EXPECT_EQ(Ask({"replay", "sim:small", "--from", "2", "--to", "4"})["frames"], 3);
  const Finished backwards = Clearway({"replay", "sim:small", "--from", "4", "--to", "2"});
  EXPECT_EQ(backwards.exit_code, 2);
  const Finished beyond = Clearway({"replay", "sim:small", "--to", "100000"});
  EXPECT_EQ(beyond.exit_code, 2);
  EXPECT_THAT(beyond.err, HasSubstr("ends at frame"));
}

TEST_F(CliServer, ReplayWithErrorsOfTheSource) {
  Ask({"replay", "sim:small", "--frames", "4", "--unlabelled", "1"});
  const json objects = Ask({"objects"})["objects"];
  ASSERT_FALSE(objects.empty());
  for (const json& object : objects) EXPECT_NE(object["id"], 1);
  EXPECT_EQ(Clearway({"replay", "sim:small", "--wrong-labels", "2"}).exit_code, 2);
}

TEST(ReplayCli, WhatComesBackUnderANewIdKeepsItsOldOne) {
  const ServerProcess server({"--scene-reidentify", "true", "--scene-motion", "track"});
  const auto on_server = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "--server", server.address()});
    const Finished dut = RunClearway(arguments);
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
    return json::parse(dut.out);
  };
  on_server({"replay", "sim:swaps", "--seed", "1", "--forget", "0.5", "--quiet"});
  const json objects = on_server({"objects"})["objects"];
  EXPECT_TRUE(std::ranges::any_of(objects, [](const json& object) {
    return !object["other_ids"].empty();
  })) << objects;
}

TEST_F(CliServer, ReplayStopsAtARefusedFrame) {
  Ask({"replay", "sim:small", "--from", "5", "--to", "5"});
  const Finished dut = Clearway({"replay", "sim:small", "--from", "0", "--to", "4"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("was refused: "));
  EXPECT_EQ(Ask({"status"})["frames_applied"], 1);
}

TEST_F(CliServer, ARecordingMakesTheSameSceneAsItsSource) {
  Replay();
  const json from_source = Ask({"status", "--hash"});
  const TemporaryFolder folder;
  const std::string file = folder / "small.cwr";
  RunClearway({"simulate", "small", "--frames", std::to_string(kFrames), "--out", file});
  Ask({"reset"});
  EXPECT_EQ(Ask({"replay", file})["applied"], kFrames);
  EXPECT_EQ(Ask({"status", "--hash"})["scene_hash"], from_source["scene_hash"]);
  EXPECT_EQ(from_source["scene_hash"].get<std::string>().size(), 32u);
}

// A folder with poses of both kinds.
std::string WriteExampleWithOxts(const TemporaryFolder& folder) {
  WriteExample(folder);
  folder.Write("poses_oxts.csv", kPoses);
  folder.Write("objects_oxts.csv", kObjects);
  return folder.path();
}

TEST_F(CliServer, ReplayTellsOfPosesThatDrift) {
  const TemporaryFolder folder;
  const std::string path = WriteExampleWithOxts(folder);
  const Finished icp = Clearway({"replay", path, "--poses", "icp"});
  EXPECT_EQ(icp.exit_code, 0) << icp.err;
  EXPECT_THAT(icp.err, Not(HasSubstr("note")));
  Ask({"reset"});
  const Finished oxts = Clearway({"replay", path, "--poses", "oxts"});
  EXPECT_EQ(oxts.exit_code, 0) << oxts.err;
  EXPECT_THAT(oxts.err, HasSubstr("--scene-sensor-pose-error-m 1 "));
  Ask({"reset"});
  const Finished quiet = Clearway({"replay", path, "--poses", "oxts", "--quiet"});
  EXPECT_EQ(quiet.err, "");
}

TEST_F(CliServer, ReplayDoesNotTellOfThemAServerThatRegistersScans) {
  const TemporaryFolder folder;
  const std::string path = WriteExampleWithOxts(folder);
  const std::vector<std::string> registers = {"--scene-sensor-pose-error-m", "1"};
  server_ = std::make_unique<ServerProcess>(registers);
  const Finished oxts = Clearway({"replay", path, "--poses", "oxts"});
  EXPECT_EQ(oxts.exit_code, 0) << oxts.err;
  EXPECT_THAT(oxts.err, Not(HasSubstr("note")));
}

TEST_F(CliServer, InfoCountsAndNamesWhatCounts) {
  const TemporaryFolder folder;
  WriteExample(folder);
  std::string poses = kPoses;
  folder.Write("poses_icp.csv", poses.replace(poses.find("6,1,0,0,2"), 9, "6,1,0,0,2e5"));
  std::filesystem::remove(folder / "points/0005.bin");
  const Finished dut = RunClearway({"info", folder.path(), "--json"});
  ASSERT_EQ(dut.exit_code, 0) << dut.err;
  const json info = json::parse(dut.out);
  EXPECT_EQ(info["frames"], 2);
  ASSERT_EQ(info["objects"].size(), 1u);  // the cyclist was in the last frame alone
  EXPECT_EQ(info["objects"][0]["frames"], 2);
  EXPECT_EQ(info["missing_points"]["count"], 1);
  const std::string file = folder.path() / "points/0005.bin";
  EXPECT_EQ(info["missing_points"]["first"],
            json::parse(R"([{"frame": 5, "file": ")" + file + R"("}])"));
  EXPECT_THAT(RunClearway({"info", folder.path()}).out,
              HasSubstr("missing     1 file of points:\n            frame 5: " + file + "\n"));
}

}  // namespace
}  // namespace clearway
