#include "clearway/io/lidar_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

constexpr char kPoses[] =
    "frame,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
    "4,1,0,0,0,0,1,0,0,0,0,1,1.5\n"
    "5,1,0,0,1,0,1,0,0,0,0,1,1.5\n"
    "6,1,0,0,2,0,1,0,0,0,0,1,1.5\n";
constexpr char kObjects[] =
    "frame,track,type,occluded,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
    "5,2,Van,0,4,2,2,1,1,0,0,10,0,1,0,3,0,0,1,1\n"
    "4,2,Van,0,4,2,2,1,1,0,0,9,0,1,0,3,0,0,1,1\n"
    "6,2,\"Van, white\",0,4,2,2,0,0,-1,0,10,1,0,0,3,0,0,1,1\n"
    "6,3,Cyclist,0,2,1,2,0,1,0,0,5,0,1,0,5,0,0,1,1\n";

std::string Point(float x, float y, float z, std::int16_t label) {
  std::string record(14, '\0');
  const float xyz[3] = {x, y, z};
  std::memcpy(record.data(), xyz, 12);
  std::memcpy(record.data() + 12, &label, 2);
  return record;
}

// Three frames, 4 to 6, of one van that moves 1 m, then turns a quarter.
void WriteExample(const TemporaryFolder& folder) {
  folder.Write("poses_icp.csv", kPoses);
  folder.Write("objects_icp.csv", kObjects);
  folder.Write("points/0004.bin", Point(1, 2, 3, 0) + Point(4, 5, 6, 2) + Point(7, 8, 9, -1));
  folder.Write("points/0005.bin", Point(1, 1, 1, 77));
  folder.Write("points/0006.bin", "");
}

std::string ErrorOf(const TemporaryFolder& folder, const LidarFolderOptions& options = {}) {
  const auto opened = OpenLidarFolder(folder.path(), options);
  EXPECT_FALSE(opened.ok());
  return std::string(opened.status().message());
}

TEST(LidarFolder, Empty) {
  TemporaryFolder folder;
  EXPECT_EQ(OpenLidarFolder(folder / "nowhere").status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(ErrorOf(folder), HasSubstr("poses.csv"));
}

TEST(LidarFolder, FramesCarryPointsLabelsStampsAndPoses) {
  TemporaryFolder folder;
  WriteExample(folder);
  const auto dut = OpenLidarFolder(folder.path());
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->frames.frame_count, 3u);
  const auto frame = dut->frames.read(0);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->sequence, 4u);
  EXPECT_EQ(frame->stamp, TimeFromNanoseconds(400'000'000));
  EXPECT_EQ(frame->T_W_S, Pose::Translation(0, 0, 1.5));
  ASSERT_EQ(frame->points_S.size(), 3u);
  EXPECT_EQ(frame->points_S[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(frame->labels, (std::vector<ObjectId>{0, 2, kIgnoreLabel}));
  EXPECT_TRUE(frame->motions.empty());
  EXPECT_TRUE(Validate(*frame, {}).ok());
}

TEST(LidarFolder, MotionsJoinConsecutiveBoxes) {
  TemporaryFolder folder;
  WriteExample(folder);
  const auto dut = OpenLidarFolder(folder.path());
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto frame = dut->frames.read(2);
  ASSERT_TRUE(frame.ok()) << frame.status();
  ASSERT_EQ(frame->motions.size(), 1u);  // the cyclist has no box before
  const ObjectMotion& motion = frame->motions[0];
  EXPECT_EQ(motion.id, 2);
  EXPECT_EQ(motion.from, TimeFromNanoseconds(500'000'000));
  // A quarter turn about the box' centre, which stays where it is.
  EXPECT_TRUE((motion.H_W * Eigen::Vector3d(10, 3, 1)).isApprox(Eigen::Vector3d(10, 3, 1), 1e-9));
  EXPECT_TRUE((motion.H_W * Eigen::Vector3d(11, 3, 1)).isApprox(Eigen::Vector3d(10, 4, 1), 1e-9));
}

TEST(LidarFolder, ObjectsAsPoses) {
  TemporaryFolder folder;
  WriteExample(folder);
  LidarFolderOptions options;
  options.objects = LidarObjects::kPoses;
  const auto dut = OpenLidarFolder(folder.path(), options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto frame = dut->frames.read(2);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_TRUE(frame->motions.empty());
  ASSERT_EQ(frame->poses.size(), 2u);
  EXPECT_EQ(frame->poses[1].id, 3);
  EXPECT_EQ(frame->poses[1].T_W_B, Pose::Translation(5, 5, 1));
}

TEST(LidarFolder, ObjectsLeftOut) {
  TemporaryFolder folder;
  WriteExample(folder);
  LidarFolderOptions options;
  options.objects = LidarObjects::kNone;
  const auto dut = OpenLidarFolder(folder.path(), options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(1)->motions.empty());
  EXPECT_TRUE(dut->frames.read(1)->poses.empty());
}

TEST(LidarFolder, ALabelNeedsNoBox) {
  TemporaryFolder folder;
  WriteExample(folder);
  const auto frame = OpenLidarFolder(folder.path())->frames.read(1);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->labels, std::vector<ObjectId>{77});
}

TEST(LidarFolder, BoxesAndPosesCoverTheWholeTables) {
  TemporaryFolder folder;
  WriteExample(folder);
  LidarFolderOptions options;
  options.first_frame = 5;
  options.last_frame = 5;
  const auto dut = OpenLidarFolder(folder.path(), options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 1u);
  EXPECT_TRUE(dut->frames.read(0)->motions.empty());  // frame 4 is not part of the range
  EXPECT_EQ(dut->frames.read(1).status().code(), absl::StatusCode::kOutOfRange);
  EXPECT_EQ(dut->poses.size(), 3u);
  ASSERT_EQ(dut->boxes.size(), 4u);
  EXPECT_EQ(dut->boxes[0].frame, 4);
  EXPECT_EQ(dut->boxes[2].type, "Van, white");
  EXPECT_EQ(dut->boxes[2].size_m, Eigen::Vector3d(4, 2, 2));
  EXPECT_EQ(dut->boxes[1].n_points, 1);
}

TEST(LidarFolder, StampsComeFromTheirColumn) {
  TemporaryFolder folder;
  folder.Write("poses.csv",
               "frame,timestamp_ns,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
               "0,315973157959879000,1,0,0,0,0,1,0,0,0,0,1,0\n");
  folder.Write("objects.csv",
               "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n");
  folder.Write("points/0000.bin", "");
  const auto dut = OpenLidarFolder(folder.path());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(ToNanoseconds(dut->frames.read(0)->stamp), 315973157959879000);
}

TEST(LidarFolder, MissingPointsAreRefusedUnlessAllowed) {
  TemporaryFolder folder;
  WriteExample(folder);
  std::filesystem::remove(folder / "points/0005.bin");
  EXPECT_THAT(ErrorOf(folder), AllOf(HasSubstr("0005.bin"), HasSubstr("1 of 3 frames")));
  LidarFolderOptions options;
  options.allow_missing_points = true;
  const auto dut = OpenLidarFolder(folder.path(), options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(1)->points_S.empty());
  EXPECT_EQ(dut->frames.read(1)->motions.size(), 1u);
}

TEST(LidarFolder, RefusesTablesCutOffAtAnyByte) {
  TemporaryFolder folder;
  for (const std::string name : {"poses_icp.csv", "objects_icp.csv"}) {
    WriteExample(folder);
    const std::string whole = BytesOf(folder / name);
    for (std::size_t size = whole.size(); size-- > 0;) {
      std::filesystem::resize_file(folder / name, size);
      const auto dut = OpenLidarFolder(folder.path());
      // Cut between two lines, a table is a shorter table; that objects' frames and poses agree is
      // checked all the same.
      const bool between_lines = size > 0 && whole[size - 1] == '\n';
      if (dut.ok()) {
        EXPECT_TRUE(between_lines && name == "objects_icp.csv") << name << " of " << size;
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
  folder.Write("points/0004.bin", Point(0, 0, 0, 0) + Point(0, 0, 0, -2));
  const auto frame = OpenLidarFolder(folder.path())->frames.read(0);
  EXPECT_THAT(std::string(frame.status().message()),
              HasSubstr("0004.bin, point 1 at byte 26: label -2; the lowest is -1"));
}

TEST(LidarFolder, RefusesBadRowsNamingThem) {
  TemporaryFolder folder;
  const auto poses_with = [&](const std::string& row) {
    WriteExample(folder);
    folder.Write("poses_icp.csv", kPoses + row);
    return ErrorOf(folder);
  };
  EXPECT_THAT(poses_with("x,1,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("line 5, column frame: 'x'"));
  EXPECT_THAT(poses_with("7,1,0,0,inf,0,1,0,0,0,0,1,0\n"), HasSubstr("line 5, column T03: 'inf'"));
  EXPECT_THAT(poses_with("7,2,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("not a rotation"));
  EXPECT_THAT(poses_with("7,-1,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("not a rotation"));
  EXPECT_THAT(poses_with("6,1,0,0,0,0,1,0,0,0,0,1,0\n"), HasSubstr("does not come after frame 6"));

  const auto objects_with = [&](const std::string& row) {
    WriteExample(folder);
    folder.Write("objects_icp.csv", kObjects + row);
    return ErrorOf(folder);
  };
  const std::string identity = ",1,0,0,0,0,1,0,0,0,0,1,0\n";
  EXPECT_THAT(objects_with("6,0,Van,0,4,2,2,1" + identity), HasSubstr("line 6, column track: '0'"));
  EXPECT_THAT(objects_with("6,9,Van,0,4,0,2,1" + identity), HasSubstr("columns l, w, h"));
  EXPECT_THAT(objects_with("6,9,Van,0,4,1,2,-1" + identity), HasSubstr("column n_points: '-1'"));
  EXPECT_THAT(objects_with("8,9,Van,0,4,1,2,1" + identity), HasSubstr("frame 8 has no pose"));
  EXPECT_THAT(objects_with("6,3,Van,0,4,1,2,1" + identity),
              HasSubstr("frame 6 has two boxes of track 3"));
}

TEST(LidarFolder, RefusesARangeWithoutFrames) {
  TemporaryFolder folder;
  WriteExample(folder);
  LidarFolderOptions options;
  options.first_frame = 7;
  EXPECT_THAT(ErrorOf(folder, options), HasSubstr("the tables hold 4 to 6"));
}

TEST(LidarFolder, ReadsTheRealDrive) {
  const auto path = DataPath("kitti0000_fov");
  if (!path) return;
  LidarFolderOptions options;
  for (const LidarPoses poses : {LidarPoses::kIcp, LidarPoses::kOxts}) {
    options.poses = poses;
    const auto dut = OpenLidarFolder(*path, options);
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_EQ(dut->frames.frame_count, 100u);
    EXPECT_EQ(dut->boxes.size(), 301u);
    std::size_t points = 0, motions = 0;
    for (std::size_t i = 0; i < dut->frames.frame_count; ++i) {
      const auto frame = dut->frames.read(i);
      ASSERT_TRUE(frame.ok()) << frame.status();
      ASSERT_TRUE(Validate(*frame, {}).ok()) << Validate(*frame, {});
      points += frame->points_S.size();
      motions += frame->motions.size();
    }
    EXPECT_GT(points, 1'900'000u);
    EXPECT_GT(motions, 250u);
  }
}

TEST(LidarFolder, ReadsTheRealTracksWithoutTheirScans) {
  const auto path = DataPath("av2_adcf7d18");
  if (!path) return;
  EXPECT_EQ(OpenLidarFolder(*path).status().code(), absl::StatusCode::kNotFound);
  LidarFolderOptions options;
  options.allow_missing_points = true;
  const auto dut = OpenLidarFolder(*path, options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 156u);
  EXPECT_EQ(dut->boxes.size(), 12078u);
  EXPECT_GT(dut->frames.read(0)->points_S.size(), 100'000u);
  for (std::size_t i = 0; i < 156; ++i) ASSERT_TRUE(Validate(*dut->frames.read(i), {}).ok()) << i;
}

}  // namespace
}  // namespace clearway
