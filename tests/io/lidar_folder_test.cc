#include "clearway/io/lidar_folder.h"

#include <gmock/gmock.h>

#include "absl/strings/str_cat.h"
#include "io/lidar_example.h"
#include "support/data_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

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

TEST(LidarFolder, PosesOfGpsAreKnownToDrift) {
  TemporaryFolder folder;
  WriteExample(folder);
  folder.Write("poses_oxts.csv", kPoses);
  folder.Write("objects_oxts.csv", kObjects);
  const auto icp = OpenLidarFolder(folder.path());
  const auto oxts = OpenLidarFolder(folder.path(), {.poses = LidarPoses::kOxts});
  ASSERT_TRUE(icp.ok() && oxts.ok()) << oxts.status();
  EXPECT_EQ(icp->frames.sensor_pose_error_m, 0);
  EXPECT_EQ(icp->frames.sensor_pose_error_rad, 0);
  EXPECT_EQ(oxts->frames.sensor_pose_error_m, 1);
  EXPECT_EQ(oxts->frames.sensor_pose_error_rad, 0.02);
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

// The cyclist is there in the first frame and in the last.
TEST(LidarFolder, AfterAGapAMotionBeginsAtTheLastBox) {
  TemporaryFolder folder;
  WriteExample(folder);
  folder.Write("objects_icp.csv",
               std::string(kObjects) + "4,3,Cyclist,0,2,1,2,0,1,0,0,3,0,1,0,5,0,0,1,1\n");
  for (const int over_ms : {0, 100, 5000}) {
    const auto dut =
        OpenLidarFolder(folder.path(), {.motions_over = std::chrono::milliseconds(over_ms)});
    ASSERT_TRUE(dut.ok()) << dut.status();
    const auto frame = dut->frames.read(2);
    ASSERT_TRUE(frame.ok()) << frame.status();
    ASSERT_EQ(frame->motions.size(), 2u);
    EXPECT_EQ(frame->motions[1].id, 3);
    EXPECT_EQ(frame->motions[1].from, TimeFromNanoseconds(400'000'000));
    EXPECT_TRUE(frame->motions[1].H_W.translation.isApprox(Eigen::Vector3d(2, 0, 0), 1e-9));
  }
}

// Longer ago than objects are usually kept: the id may be another's by now.
TEST(LidarFolder, AfterALongGapThereIsNoMotion) {
  for (const auto& [last_s, motions] : {std::pair{10, 1u}, {11, 0u}}) {
    TemporaryFolder folder;
    folder.Write("poses.csv", absl::StrCat("frame,timestamp_ns,T00,T01,T02,T03,T10,T11,T12,T13,T20,"
                                           "T21,T22,T23\n",
                                           "0,0,1,0,0,0,0,1,0,0,0,0,1,1\n",
                                           "1,1000000000,1,0,0,0,0,1,0,0,0,0,1,1\n", "2,", last_s,
                                           "000000000,1,0,0,0,0,1,0,0,0,0,1,1\n"));
    folder.Write("objects.csv",
                 "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n"
                 "0,3,Car,4,2,2,1,1,0,0,3,0,1,0,5,0,0,1,1\n"
                 "2,3,Car,4,2,2,1,1,0,0,5,0,1,0,5,0,0,1,1\n");
    const auto dut = OpenLidarFolder(folder.path(), {.allow_missing_points = true});
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_EQ(dut->frames.read(2)->motions.size(), motions) << last_s;
  }
}

TEST(LidarFolder, MotionsOverLongerBeginAtTheFirstBoxWithin) {
  TemporaryFolder folder;
  WriteExample(folder);
  for (const auto& [over_ms, from_ms] : {std::pair{50, 500}, {100, 500}, {200, 400}, {5000, 400}}) {
    const auto dut =
        OpenLidarFolder(folder.path(), {.motions_over = std::chrono::milliseconds(over_ms)});
    ASSERT_TRUE(dut.ok()) << dut.status();
    const auto frame = dut->frames.read(2);
    ASSERT_TRUE(frame.ok()) << frame.status();
    ASSERT_EQ(frame->motions.size(), 1u);
    const ObjectMotion& motion = frame->motions[0];
    EXPECT_EQ(motion.from, TimeFromNanoseconds(from_ms * 1'000'000)) << over_ms;
    const Eigen::Vector3d center_then(from_ms == 400 ? 9 : 10, 3, 1);
    EXPECT_TRUE((motion.H_W * center_then).isApprox(Eigen::Vector3d(10, 3, 1), 1e-9)) << over_ms;
  }
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

TEST(LidarFolder, ReadsTheRealDrive) {
  const auto path = DataPath("kitti0000_fov");
  if (!path) GTEST_SKIP() << "no recorded data";
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
  if (!path) GTEST_SKIP() << "no recorded data";
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

// Whoever goes on without it never saw the objects there.
TEST(LidarFolder, NoMotionStartsAtAFrameThatCouldNotBeRead) {
  const TemporaryFolder folder;
  WriteExample(folder);
  folder.Write("points/0005.bin", "cut off");
  const auto dut = OpenLidarFolder(folder.path());
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(0).ok());
  EXPECT_FALSE(dut->frames.read(1).ok());
  const auto frame = dut->frames.read(2);
  ASSERT_TRUE(frame.ok()) << frame.status();
  ASSERT_EQ(frame->motions.size(), 1u);
  EXPECT_EQ(frame->motions[0].from, dut->poses[0].stamp);
}

TEST(LidarFolder, FramesWithoutAFileOfPointsAreListed) {
  const TemporaryFolder folder;
  WriteExample(folder);
  EXPECT_TRUE(OpenLidarFolder(folder.path())->missing_points.empty());
  std::filesystem::remove(folder / "points/0005.bin");
  const auto dut = OpenLidarFolder(folder.path(), {.allow_missing_points = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->missing_points.size(), 1u);
  EXPECT_EQ(dut->missing_points[0].first, 5);
  EXPECT_EQ(dut->missing_points[0].second, folder.path() / "points/0005.bin");
}

}  // namespace
}  // namespace clearway
