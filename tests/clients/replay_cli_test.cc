// clearway replay against a real server.
#include <gmock/gmock.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "clients/cli_server.h"
#include "io/lidar_example.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(CliServer, ReplayIsAppliedOnce) {
  const json first = Replay();
  EXPECT_EQ(first["frames"], kFrames);
  EXPECT_EQ(first["applied"], kFrames);
  EXPECT_EQ(first["repeated"], 0);
  const json status = Ask({"status"});
  EXPECT_EQ(status["frames_applied"], kFrames);
  EXPECT_EQ(status["version"], first["version"]);
  EXPECT_EQ(Replay()["repeated"], kFrames);
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
  const Finished oxts = Clearway({"replay", path, "--poses", "oxts"});
  EXPECT_EQ(icp.exit_code, 0) << icp.err;
  EXPECT_THAT(icp.err, Not(HasSubstr("note")));
  EXPECT_EQ(oxts.exit_code, 0) << oxts.err;
  EXPECT_THAT(oxts.err, HasSubstr("--scene-sensor-pose-error-m 1 "));
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

}  // namespace
}  // namespace clearway
