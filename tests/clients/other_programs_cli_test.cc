// Files as other programs write them, and files of other programs.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_replace.h"
#include "clearway/io/octomap_file.h"
#include "clients/cli_server.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

class OtherPrograms : public CliServer {
 protected:
  void StartWith(const std::string& resolution_m) {
    server_ = std::make_unique<ServerProcess>(std::vector<std::string>{
        "--scene-resolution-m", resolution_m, "--scene-object-resolution-m", resolution_m});
    ASSERT_FALSE(server_->address().empty()) << "the server did not start";
  }
  std::string WriteMap(const std::string& name, double resolution_m) {
    VoxelMap map(resolution_m);
    for (int i = 0; i < 64; ++i) map.Set({i % 4, i / 4 % 4, i / 16}, map.model().clamp_min);
    map.Set({3, 3, 3}, map.model().clamp_max);
    return folder_.Write(name, *SerializeOctomap(map, OctomapFormat::kBinary)).string();
  }
  std::string StatusAt(const std::string& point) {
    return Ask({"occupancy", "--at", point})["points"][0]["status"].get<std::string>();
  }

  TemporaryFolder folder_;
};

TEST_F(OtherPrograms, APriorOfSixDigitsLoads) {
  StartWith("0.3333333333333333");
  std::string bytes = BytesOf(WriteMap("ours.bt", 1.0 / 3));
  ASSERT_EQ(absl::StrReplaceAll({{"res 0.3333333333333333\n", "res 0.333333\n"}}, &bytes), 1);
  Ask({"load-prior", folder_.Write("third.bt", bytes).string()});
  EXPECT_EQ(StatusAt("1.2,1.2,1.2"), "OCCUPIED");
  EXPECT_EQ(StatusAt("0.1,0.1,0.1"), "FREE");
}

TEST_F(OtherPrograms, APriorOfAnotherResolutionIsResampledOnRequest) {
  StartWith("0.1");
  const std::string map = WriteMap("fine.bt", 0.05);
  const Finished refused = Clearway({"load-prior", map});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("0.05 m"), HasSubstr("0.1 m"),
                                 HasSubstr("; --resample converts it")));
  const json dut = Ask({"load-prior", map, "--resample"});
  EXPECT_EQ(dut["resampled"]["from_m"], 0.05);
  EXPECT_EQ(dut["resampled"]["to_m"], 0.1);
  EXPECT_EQ(StatusAt("0.15,0.15,0.15"), "OCCUPIED");
  EXPECT_EQ(StatusAt("0.05,0.05,0.05"), "FREE");
  EXPECT_EQ(StatusAt("0.25,0.05,0.05"), "UNKNOWN_SPACE");
}

// A file of a few hundred bytes.
TEST_F(OtherPrograms, APriorThatWouldBecomeTooLargeIsRefused) {
  StartWith("0.1");
  VoxelMap map(10);
  for (int i = 0; i < 4'096; ++i) {
    map.Set({i % 16, i / 16 % 16, i / 256}, map.model().clamp_min);
  }
  const std::string file = folder_ / "coarse.bt";
  ASSERT_TRUE(WriteOctomap(file, map).ok());
  const Finished dut = Clearway({"load-prior", file, "--resample"});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("in voxels of 0.1 m it would have about 4096000000 voxels; the "
                                 "limit is 134217728. Start the server with larger voxels "
                                 "(clearway-server --scene-resolution-m); the map's have 10 m"));
}

TEST_F(OtherPrograms, AFolderIsNoPrior) {
  std::filesystem::create_directories(folder_ / "map.bt");
  const Finished dut = Clearway({"load-prior", (folder_ / "map.bt").string()});
  EXPECT_EQ(dut.exit_code, 1);
  EXPECT_THAT(dut.err, HasSubstr("map.bt: is a folder"));
}

TEST_F(OtherPrograms, AMeshNeedsNoMaterials) {
  folder_.Write("mesh/foo.obj", std::string("mtllib missing.mtl\n") + kTetrahedron);
  const auto robot =
      folder_.Write("robots/r.json", R"({"name":"r","links":[{"name":"b","shapes":[)"
                                     R"({"type":"mesh","file":"../mesh/foo.obj"}]}]})");
  const Finished dut =
      Clearway({"check", "--robot", robot.string(), "--state", "0,0,0,0", "--unknown", "free"});
  EXPECT_EQ(dut.exit_code, 0) << dut.err;
}

TEST_F(OtherPrograms, StatesMayBeginWithAByteOrderMark) {
  const auto states = folder_.Write("states.csv", "\xEF\xBB\xBFx,y,z,yaw\r\n1,2,0.5,0\r\n");
  const json dut = Ask({"check", "--robot", "box:1,1,1", "--states", states.string()});
  EXPECT_EQ(dut["states"].size(), 1u) << dut;
}

TEST_F(OtherPrograms, PlansTakeRoundedQuaternionsAndTellNumbersApart) {
  const std::string begin =
      R"({"name": "t", "robot": "cylinder:0.3,1", "area_m": [[-6, -4, 0], [6, 4, 3]],)"
      R"( "max_speed_mps": 1, "max_turn_radps": 1, "time_limit_s": 60, "unknown": "free", )";
  const auto plan = [&](const std::string& rest) {
    return Clearway({"plan", folder_.Write("plan.json", begin + rest).string()});
  };
  for (const char* goal : {"0.70711, 0.70711", "0.7071, 0.7071", "0.707, 0.707"}) {
    const Finished dut = plan(absl::StrCat(
        R"("space": {"type": "flight", "turns": true}, "start": [-5, 0, 1, 0, 0, 0, 1], )",
        R"("goal": [5, 0, 1, 0, 0, )", goal, "]}"));
    EXPECT_EQ(dut.exit_code, 0) << dut.err;
  }
  const Finished beyond = plan(
      R"("space": {"type": "plane", "turns": false}, "start": [-5, 0], "goal": [6.0000001, 0]})");
  EXPECT_NE(beyond.exit_code, 0);
  EXPECT_THAT(beyond.err, HasSubstr("goal[0] is 6.0000001; it must lie between -6 and 6"));
}

TEST_F(OtherPrograms, FilesAreNamedByWhatTheyAre) {
  const auto info = [&](const std::string& name, const std::string& bytes) {
    return RunClearway({"info", folder_.Write(name, bytes).string()});
  };
  EXPECT_THAT(info("cloud.pcd", "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n").err,
              AllOf(HasSubstr("a point cloud (PCD)"), Not(HasSubstr("SQLite"))));
  EXPECT_THAT(info("cloud.ply", "ply\nformat ascii 1.0\n").err,
              AllOf(HasSubstr("PLY"), Not(HasSubstr("SQLite"))));
  EXPECT_THAT(info("drive.bag", "#ROSBAG V2.0\n").err, HasSubstr("a ROS 1 bag"));
  EXPECT_THAT(info("a.txt", "hello\n").err, HasSubstr("a text"));
  const Finished map = RunClearway({"info", WriteMap("MAP.BT", 0.1), "--json"});
  EXPECT_EQ(map.exit_code, 0) << map.err;
  EXPECT_EQ(json::parse(map.out)["kind"], "octomap");
  for (const char* name : {"x.bt", "X.OT", "x.ply"}) {
    const std::string out = (folder_ / name).string();
    for (const char* command : {"simulate", "record"}) {
      const std::string source = command == std::string("record") ? "sim:small" : "small";
      const Finished dut = RunClearway({command, source, "--out", out});
      EXPECT_NE(dut.exit_code, 0) << command << name;
      EXPECT_FALSE(std::filesystem::exists(out));
    }
  }
}

}  // namespace
}  // namespace clearway
