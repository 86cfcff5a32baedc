// Flags of a source that are for other kinds of source, or for what it does not hold.
#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include "clients/run_clearway.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using Flags = std::vector<std::string>;

Finished With(Flags arguments, const Flags& flags) {
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  return RunClearway(arguments);
}

// Refused as a usage error that names the first of the flags and says this.
void ExpectRefused(const Flags& arguments, const Flags& flags, const std::string& said) {
  const Finished dut = With(arguments, flags);
  EXPECT_EQ(dut.exit_code, 2) << flags.front();
  EXPECT_THAT(dut.err, AllOf(StartsWith("clearway: " + flags.front()), HasSubstr(said)));
}

const std::vector<Flags> kOfSimulations = {{"--seed", "1"},        {"--noise", "none"},
                                           {"--range-noise", "0"}, {"--frames", "5"},
                                           {"--beams", "16"},      {"--keep-no-return"}};
const std::vector<Flags> kOfFolders = {
    {"--poses", "any"}, {"--stride", "1"}, {"--max-depth", "5"}, {"--allow-missing-points"}};

TEST(SourceFlags, OfFoldersAreRefusedOfASimulation) {
  for (const Flags& flags : kOfFolders) {
    for (const char* command : {"replay", "evaluate"}) {
      ExpectRefused({command, "sim:small"}, flags, "sim:small is a simulation");
    }
  }
  ExpectRefused({"info", "sim:small"}, {"--poses", "icp"}, "sim:small is a simulation");
}

TEST(SourceFlags, OfSourcesThatAreReadAreRefusedOfARecording) {
  std::vector<Flags> all = kOfSimulations;
  all.insert(all.end(), kOfFolders.begin(), kOfFolders.end());
  all.push_back({"--objects", "motions"});
  const TemporaryFolder folder;
  const std::string recording = folder / "drive.cwr";
  std::ofstream(recording).close();
  for (const Flags& flags : all) {
    ExpectRefused({"replay", recording}, flags, "drive.cwr is a recording");
  }
  ExpectRefused({"info", recording}, {"--poses", "any"}, "drive.cwr is a recording");
  ExpectRefused({"info", "map.bt"}, {"--poses", "any"}, "map.bt is an OctoMap file");
}

// What a folder is, a file in it tells; flags are judged before it is read.
TEST(SourceFlags, OfWhatIsNotThereSayThat) {
  for (const char* command : {"replay", "evaluate", "info"}) {
    const Finished dut = With({command, "no_such_drive"}, {"--poses", "icp"});
    EXPECT_EQ(dut.exit_code, 1) << command;
    EXPECT_THAT(dut.err, HasSubstr("no_such_drive: no such file")) << command;
  }
}

TEST(SourceFlags, AreRefusedOfEachFormatThatTheyAreNotFor) {
  const std::vector<std::tuple<std::string, std::string, std::vector<Flags>>> cases = {
      {"poses.csv", "is a folder of LiDAR scans", {{"--stride", "2"}, {"--max-depth", "5"}}},
      {"carla_sensor.csv", "CARLA", {{"--poses", "icp"}, {"--stride", "2"}, {"--max-depth", "5"}}},
      {"depth.txt", "is a TUM RGB-D sequence", {{"--poses", "icp"}}},
      {"landmark_mapping.txt", "is a ClusterSLAM", {{"--poses", "icp"}, {"--stride", "2"}}},
      {"rgbd_camera_pose_log.csv", "DynoSAM", {{"--poses", "icp"}, {"--max-depth", "5"}}},
  };
  for (const auto& [file, name, wrong] : cases) {
    const TemporaryFolder folder;
    folder.Write(file, "");
    folder.Write("pose/0000.txt", "");  // what else ClusterSLAM's has
    std::vector<Flags> all = kOfSimulations;
    all.push_back({"--parts", "one"});
    all.insert(all.end(), wrong.begin(), wrong.end());
    for (const Flags& flags : all) ExpectRefused({"evaluate", folder.path()}, flags, name);
    const Finished missing = With({"replay", folder.path()}, {"--allow-missing-points"});
    EXPECT_EQ(missing.exit_code, 1) << name;
    EXPECT_THAT(missing.err, Not(HasSubstr("--allow"))) << name;
  }
}

TEST(SourceFlags, NameObjectsOfTheSource) {
  ExpectRefused({"evaluate", "sim:small"}, {"--unlabelled", "2,9"},
                "sim:small has no object 9; it has 1, 2, 3");
  EXPECT_EQ(With({"evaluate", "sim:small"}, {"--frames", "2", "--unlabelled", "2,3"}).exit_code, 0);
}

TEST(SourceFlags, AreAboutWhatTheSimulationHas) {
  ExpectRefused({"evaluate", "sim:small"}, {"--parts", "one"}, "sim:small has none");
  ExpectRefused({"replay", "sim:lab"}, {"--beams", "16"}, "is a depth camera");
  ExpectRefused({"simulate", "lab", "-o", "lab.cwr"}, {"--beams", "16"}, "is a depth camera");
  EXPECT_EQ(With({"evaluate", "sim:articulated"}, {"--frames", "2", "--parts", "one"}).exit_code,
            0);
}

TEST(SourceFlags, HelpTellsWhatTheyAreFor) {
  const std::string help = With({"replay"}, {"--help"}).out;
  for (const char* told : {"Simulator (of sim:NAME alone)", "Of a TUM RGB-D sequence",
                           "any source but recordings", "worlds of sim:occlusions"}) {
    EXPECT_THAT(help, HasSubstr(told));
  }
}

}  // namespace
}  // namespace clearway
