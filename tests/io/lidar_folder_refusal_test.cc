#include <gmock/gmock.h>

#include "io/lidar_example.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

TEST(LidarFolder, MissingPointsAreRefusedUnlessAllowed) {
  TemporaryFolder folder;
  WriteExample(folder);
  std::filesystem::remove(folder / "points/0005.bin");
  EXPECT_THAT(ErrorOf(folder), AllOf(HasSubstr("0005.bin"), HasSubstr("1 of 3 frames"),
                                     HasSubstr("(--allow-missing-points goes on without)")));
  LidarFolderOptions options;
  options.allow_missing_points = true;
  const auto dut = OpenLidarFolder(folder.path(), options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(1)->points_S.empty());
  EXPECT_EQ(dut->frames.read(1)->motions.size(), 1u);
}

TEST(LidarFolder, AScanWithoutAPoseIsLeftOutAndNamed) {
  TemporaryFolder folder;
  WriteExample(folder);
  folder.Write("points/0007.bin", "");
  const auto dut = OpenLidarFolder(folder.path());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 3u);
  EXPECT_EQ(dut->frames.left_out->frames, 1u);
  EXPECT_THAT(dut->frames.left_out->reasons,
              testing::ElementsAre(HasSubstr("points/0007.bin: no usable pose in poses_icp.csv")));
}

TEST(LidarFolder, TwoScansOfOneNumberAreRefused) {
  TemporaryFolder folder;
  WriteExample(folder);
  folder.Write("points/00005.bin", "");
  EXPECT_THAT(ErrorOf(folder), AllOf(HasSubstr("points/00005.bin and "),
                                     HasSubstr("points/0005.bin: two files of frame 5")));
}

TEST(LidarFolder, NamesMayHaveAnyNumberOfZeros) {
  TemporaryFolder folder;
  WriteExample(folder);
  std::filesystem::rename(folder / "points/0005.bin", folder / "points/5.bin");
  const auto dut = OpenLidarFolder(folder.path());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.read(1)->points_S.size(), 1u);
}

TEST(LidarFolder, SaysByWhatTheOtherFormatsAreTold) {
  const TemporaryFolder folder;
  for (const char* told : {"velodyne/NNNN", "depth.txt", "landmark_mapping.txt", "carla_sensor.csv",
                           "*.pcd", "calib.txt", "*_camera_pose_log.csv"}) {
    EXPECT_THAT(ErrorOf(folder), HasSubstr(told));
  }
}

TEST(LidarFolder, RefusesTablesCutOffAtAnyByte) {
  TemporaryFolder folder;
  for (const std::string name : {"poses_icp.csv", "objects_icp.csv"}) {
    WriteExample(folder);
    const std::string whole = BytesOf(folder / name);
    for (std::size_t size = whole.size(); size-- > 0;) {
      std::filesystem::resize_file(folder / name, size);
      const auto dut = OpenLidarFolder(folder.path());
      // Cut between two lines, a table is a shorter table; objects of frames without a pose are
      // left out.
      const bool between_lines = size > 0 && whole[size - 1] == '\n';
      if (dut.ok()) {
        EXPECT_TRUE(between_lines) << name << " of " << size;
        EXPECT_EQ(dut->frames.left_out->Empty(), name == "objects_icp.csv") << size;
      } else {
        EXPECT_THAT(std::string(dut.status().message()), HasSubstr(".csv"));
      }
    }
  }
}

TEST(LidarFolder, RefusesPointsCutOffInsideARecord) {
  TemporaryFolder folder;
  WriteExample(folder);
  const std::string whole = BytesOf(folder / "points/0004.bin");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    folder.Write("points/0004.bin", whole.substr(0, size));
    const auto frame = OpenLidarFolder(folder.path())->frames.read(0);
    EXPECT_EQ(frame.ok(), size % 14 == 0) << size;
    if (frame.ok()) continue;
    EXPECT_THAT(std::string(frame.status().message()),
                AllOf(HasSubstr("0004.bin"), HasSubstr("14-byte")));
  }
}

TEST(LidarFolder, RefusesALabelBelowIgnore) {
  TemporaryFolder folder;
  WriteExample(folder);
  folder.Write("points/0004.bin", PointBytes({{0, 0, 0, 0}, {0, 0, 0, -2}}));
  const auto frame = OpenLidarFolder(folder.path())->frames.read(0);
  EXPECT_THAT(std::string(frame.status().message()),
              HasSubstr("0004.bin, point 1 at byte 26: label -2; the lowest is -1"));
}

// Of the one row that is left out.
std::string LeftOutOf(const TemporaryFolder& folder) {
  const auto opened = OpenLidarFolder(folder.path());
  EXPECT_TRUE(opened.ok()) << opened.status();
  if (!opened.ok()) return "";
  EXPECT_EQ(opened->poses.size(), 3u);
  EXPECT_EQ(opened->boxes.size(), 4u);
  EXPECT_EQ(opened->frames.left_out->rows, 1u);
  return opened->frames.left_out->reasons.empty() ? "" : opened->frames.left_out->reasons[0];
}

TEST(LidarFolder, LeavesBadRowsOutNamingThem) {
  TemporaryFolder folder;
  const auto poses_with = [&](const std::string& row) {
    WriteExample(folder);
    folder.Write("poses_icp.csv", kPoses + row);
    return LeftOutOf(folder);
  };
  EXPECT_THAT(poses_with("x,1,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("line 5, column frame: 'x'"));
  EXPECT_THAT(poses_with("7,1,0,0,inf,0,1,0,0,0,0,1,0\n"), HasSubstr("line 5, column T03: 'inf'"));
  EXPECT_THAT(poses_with("7,2,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("not a rotation"));
  EXPECT_THAT(poses_with("7,-1,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("a mirror image"));
  EXPECT_THAT(poses_with("6,1,0,0,0,0,1,0,0,0,0,1,0\n"),
              HasSubstr("line 5: a second row of frame 6; the first: line 4"));

  const auto objects_with = [&](const std::string& row) {
    WriteExample(folder);
    folder.Write("objects_icp.csv", kObjects + row);
    return LeftOutOf(folder);
  };
  const std::string identity = ",1,0,0,0,0,1,0,0,0,0,1,0\n";
  EXPECT_THAT(objects_with("6,0,Van,0,4,2,2,1" + identity), HasSubstr("line 6, column track: '0'"));
  EXPECT_THAT(objects_with("6,9,Van,0,4,0,2,1" + identity), HasSubstr("columns l, w, h"));
  EXPECT_THAT(objects_with("6,9,Van,0,4,2e6,2,1" + identity), HasSubstr("'2e6' is not a number"));
  EXPECT_THAT(objects_with("6,9,Van,0,4,1,2,-1" + identity), HasSubstr("column n_points: '-1'"));
  EXPECT_THAT(objects_with("8,9,Van,0,4,1,2,1" + identity), HasSubstr("frame 8 has no pose"));
  EXPECT_THAT(objects_with("6,3,Van,0,4,1,2,1" + identity),
              HasSubstr("line 6: a second box of track 3 in frame 6; the first: line 5"));
}

TEST(LidarFolder, RefusesTablesThatAreNone) {
  TemporaryFolder folder;
  const auto poses_with = [&](const std::string& rows) {
    const std::string whole = kPoses;
    WriteExample(folder);
    folder.Write("poses_icp.csv", whole.substr(0, whole.find('\n') + 1) + rows);
    return ErrorOf(folder);
  };
  EXPECT_THAT(poses_with("4,1,0,0\n4,1,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("line 2: 4 fields"));
  EXPECT_THAT(poses_with("four,1,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("line 2, column frame"));
  EXPECT_THAT(poses_with("4,nan,0,0,0,0,1,0,0,0,0,1,0\n"),
              AllOf(HasSubstr("line 2, column T00: 'nan'"), HasSubstr("no row of the table")));
  EXPECT_THAT(poses_with(""), HasSubstr("no pose under the header"));
}

TEST(LidarFolder, OneRowOfAWrongTimeCostsThatRowAlone) {
  TemporaryFolder folder;
  WriteExample(folder);
  const std::string identity = ",1,0,0,0,0,1,0,0,0,0,1,0\n";
  folder.Write("poses_icp.csv",
               "frame,timestamp_ns,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n4,100" +
                   identity + "5,900" + identity + "6,300" + identity);
  LidarFolderOptions options;
  options.allow_missing_points = true;
  const auto dut = OpenLidarFolder(folder.path(), options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->poses.size(), 2u);
  EXPECT_THAT(dut->frames.left_out->reasons.front(), HasSubstr("stamps must ascend"));
}

TEST(LidarFolder, RefusesARangeWithoutFrames) {
  TemporaryFolder folder;
  WriteExample(folder);
  LidarFolderOptions options;
  options.first_frame = 7;
  EXPECT_THAT(ErrorOf(folder, options), HasSubstr("the tables hold 4 to 6"));
}

}  // namespace
}  // namespace clearway
