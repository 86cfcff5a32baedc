// Folders of PCD files and SemanticKITTI sequences on the command line.
#include <gmock/gmock.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "clients/cli_server.h"
#include "io/lidar_example.h"
#include "io/pcd_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

const float kNan = std::numeric_limits<float>::quiet_NaN();

// Three clouds in the three formats: a static point, one of object 7, and a lost return.
void WriteClouds(const TemporaryFolder& folder) {
  const std::vector<PcdPoint> points = {
      {5, 1, 0, 0, 0}, {8, -1, 0.5f, 0, 7}, {kNan, kNan, kNan, 0, 0}};
  folder.Write("0.pcd", AsciiPcd(points));
  folder.Write("1.pcd", BinaryPcd(points));
  folder.Write("2.pcd", CompressedPcd(points));
  folder.Write("poses.txt", "1.0 0 0 0 0 0 0 1\n1.1 0 0 0 0 0 0 1\n1.2 0 0 0 0 0 0 1\n");
}

void WriteSemanticKitti(const TemporaryFolder& folder) {
  folder.Write("sequences/00/calib.txt", "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n");
  folder.Write("sequences/00/poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n");
  for (const char* name : {"000000", "000001"}) {
    std::string points, labels;
    for (const float value : {5.f, 0.f, 0.f, 1.f, 8.f, 1.f, 0.f, 1.f, 9.f, 2.f, 0.f, 1.f}) {
      PutBytes(points, value);
    }
    for (const std::uint32_t label : {40u, 252u | 5u << 16, 10u | 9u << 16})
      PutBytes(labels, label);
    folder.Write(absl::StrCat("sequences/00/velodyne/", name, ".bin"), points);
    folder.Write(absl::StrCat("sequences/00/labels/", name, ".label"), labels);
  }
}

TEST_F(CliServer, CloudsAreNamedCountedAndSent) {
  const TemporaryFolder folder;
  WriteClouds(folder);
  const std::string path = folder.path().string();
  const Finished info = RunClearway({"info", path, "--label-field", "label"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, AllOf(HasSubstr("source      point clouds " + path),
                              HasSubstr("points      9, of which 3 are not finite"),
                              HasSubstr("labels      1 object\n")));
  EXPECT_EQ(Ask({"replay", path, "--label-field", "label"})["applied"], 3);
  const json objects = Ask({"objects"})["objects"];
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0]["id"], 7);
  const json status = Ask({"status"});
  EXPECT_EQ(status["points_not_finite"], 3);
}

TEST_F(CliServer, SemanticKittiIsNamedAndSent) {
  const TemporaryFolder folder;
  WriteSemanticKitti(folder);
  const std::string path = (folder / "sequences/00").string();
  EXPECT_THAT(RunClearway({"info", path}).out, HasSubstr("KITTI odometry sequence " + path));
  EXPECT_EQ(Ask({"replay", path})["applied"], 2);
  EXPECT_EQ(Ask({"objects"})["objects"].size(), 1u);
  Ask({"reset"});
  EXPECT_EQ(Ask({"replay", path, "--parked", "objects"})["applied"], 2);
  EXPECT_EQ(Ask({"objects"})["objects"].size(), 2u);
}

TEST(CloudsCli, FlagsOfOtherSourcesAreRefused) {
  const TemporaryFolder clouds, kitti;
  WriteClouds(clouds);
  WriteSemanticKitti(kitti);
  const std::string pcd = clouds.path().string(), odometry = (kitti / "sequences/00").string();
  const auto refused = [](std::vector<std::string> arguments) {
    const Finished dut = RunClearway(arguments);
    EXPECT_EQ(dut.exit_code, 2) << arguments.back();
    return dut.err;
  };
  EXPECT_THAT(refused({"info", pcd, "--parked", "static"}),
              HasSubstr("is a folder of point clouds"));
  EXPECT_THAT(refused({"info", pcd, "--poses", "icp"}), HasSubstr("is a folder of point clouds"));
  EXPECT_THAT(refused({"replay", pcd, "--objects", "none"}),
              HasSubstr("is a folder of point clouds"));
  EXPECT_THAT(refused({"info", odometry, "--label-field", "label"}),
              HasSubstr("is a sequence of KITTI's odometry benchmark"));
  EXPECT_THAT(refused({"info", "sim:small", "--label-field", "label"}), HasSubstr("--label-field"));
  EXPECT_THAT(refused({"info", pcd, "--pose-table", "nowhere.txt"}), HasSubstr("nowhere.txt"));
  EXPECT_EQ(refused({"info", pcd, "--label-field", ""}).empty(), false);
}

TEST(CloudsCli, AScanWithoutAPoseIsNamed) {
  const TemporaryFolder folder;
  WriteSemanticKitti(folder);
  folder.Write("sequences/00/velodyne/000002.bin", "");
  const std::string path = (folder / "sequences/00").string();
  const Finished info = RunClearway({"info", path});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, AllOf(HasSubstr("left out    1 frame of the input is left out:\n"),
                              HasSubstr("velodyne/000002.bin: no usable pose in poses.txt\n")));
  const json left_out = json::parse(RunClearway({"info", path, "--json"}).out)["left_out"];
  EXPECT_EQ(left_out["frames"], 1);
  const TemporaryFolder with_boxes;
  WriteExample(with_boxes);
  with_boxes.Write("points/0007.bin", "");
  EXPECT_THAT(RunClearway({"evaluate", with_boxes.path().string()}).err,
              AllOf(HasSubstr("warning: 1 frame of the input is left out:\n"),
                    HasSubstr("points/0007.bin: no usable pose in poses_icp.csv\n")));
}

TEST(CloudsCli, AnUnknownFolderIsToldTheLayouts) {
  const TemporaryFolder folder;
  folder.Write("notes.txt", "nothing to read\n");
  const Finished dut = RunClearway({"info", folder.path().string()});
  EXPECT_EQ(dut.exit_code, 1);
  for (const char* layout :
       {"poses.csv", "training/velodyne/NNNN", "velodyne and calib.txt", "*.pcd or *.ply",
        "depth.txt", "landmark_mapping.txt", "carla_sensor.csv", "*_camera_pose_log.csv"}) {
    EXPECT_THAT(dut.err, HasSubstr(layout));
  }
}

}  // namespace
}  // namespace clearway
