#include "clearway/io/dynosam.h"

#include <gmock/gmock.h>

#include <vector>

#include "clearway/io/within_scene.h"
#include "io/dynosam_example.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Time At_ms(std::int64_t ms) { return TimeFromNanoseconds(ms * 1'000'000); }

Frame FrameOf(const absl::StatusOr<LidarFolder>& folder, std::size_t index) {
  EXPECT_TRUE(folder.ok()) << folder.status();
  const auto frame = folder->frames.read(index);
  EXPECT_TRUE(frame.ok()) << frame.status();
  EXPECT_TRUE(Validate(*frame, {}).ok()) << Validate(*frame, {});
  return *frame;
}

TEST_F(Dynosam, IsToldByItsCameraLog) {
  EXPECT_TRUE(IsDynosam(folder_.path()));
  EXPECT_TRUE(IsDynosam(folder_ / Name("camera_pose")));
  EXPECT_FALSE(IsDynosam(folder_ / Name("object_pose")));
  EXPECT_FALSE(IsDynosam(TemporaryFolder().path()));
  EXPECT_FALSE(IsDynosam("/nowhere"));
  EXPECT_FALSE(IsDynosam("/nowhere/frontend_camera_pose_log.csv"));
}

TEST_F(Dynosam, PosesAreOfTheCamera) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 3u);
  ASSERT_EQ(dut->poses.size(), 3u);
  EXPECT_EQ(dut->poses[0].frame, 1);
  EXPECT_EQ(dut->poses[1].T_W_S.translation, Eigen::Vector3d(0, 0, 0.2));
  EXPECT_TRUE((dut->poses[1].T_W_S.rotation * Eigen::Vector3d::UnitZ())
                  .isApprox(Eigen::Vector3d::UnitX(), 1e-9));
  EXPECT_EQ(FrameOf(dut, 1).sensor_id, "camera");
  EXPECT_EQ(FrameOf(dut, 1).sequence, 2u);
}

TEST_F(Dynosam, PointsAreBroughtFromTheWorldIntoTheSensor) {
  const Frame frame = FrameOf(Open(), 1);
  ASSERT_EQ(frame.points_S.size(), 2u);
  // The camera stands at z = 0.2 and looks along x; its own x is then W's -z.
  EXPECT_TRUE(frame.points_S[0].isApprox(Eigen::Vector3f(-5, 0.5F, 1.2F), 1e-6F));
  EXPECT_TRUE(frame.points_S[1].isApprox(Eigen::Vector3f(0, 1, 2), 1e-6F));
  EXPECT_THAT(frame.labels, ElementsAre(7, 0));
  EXPECT_THAT(frame.origins_S, IsEmpty());
}

TEST_F(Dynosam, StaticPointsOfNoFrameHitAndClearNothing) {
  const auto dut = Open();
  const Frame frame = FrameOf(dut, 0);
  EXPECT_THAT(frame.labels, ElementsAre(7, 0));
  ASSERT_EQ(frame.origins_S.size(), 2u);
  EXPECT_EQ(frame.origins_S[0], Eigen::Vector3f::Zero());
  EXPECT_EQ(frame.origins_S[1], frame.points_S[1]);
  EXPECT_TRUE(frame.points_S[1].isApprox(Eigen::Vector3f(3, 1, 5.9F), 1e-6F));
  EXPECT_THAT(dut->frames.description,
              HasSubstr("1 static points of no frame come with the first"));
}

TEST_F(Dynosam, MotionsActInTheWorldFromTheFrameBefore) {
  const auto dut = Open();
  const Frame second = FrameOf(dut, 1), third = FrameOf(dut, 2);
  EXPECT_THAT(FrameOf(dut, 0).motions, IsEmpty());
  ASSERT_EQ(second.motions.size(), 1u);
  EXPECT_EQ(second.motions[0].id, 7);
  EXPECT_EQ(second.motions[0].H_W.translation, Eigen::Vector3d(0.2, 0, 0));
  EXPECT_EQ(second.motions[0].from, At_ms(100));
  EXPECT_EQ(second.stamp, At_ms(200));
  ASSERT_EQ(third.motions.size(), 1u);  // 9's is the identity that a track begins with
  EXPECT_EQ(third.motions[0].from, At_ms(200));
  EXPECT_THAT(dut->frames.description,
              HasSubstr("2 motions that start at no known frame are left out"));
}

TEST_F(Dynosam, AnObjectMayStandStill) {
  folder_.Write(Name("object_motion"),
                DynosamObjectLog({"2,7,0.2,0,0,0,0,0,1", "3,7,0,0,0,0,0,0,1"}));
  EXPECT_EQ(FrameOf(Open(), 1).motions.size(), 1u);
  EXPECT_EQ(FrameOf(Open(), 2).motions.size(), 1u);
}

TEST_F(Dynosam, ObjectsAsAskedFor) {
  const Frame frame = FrameOf(Open({.objects = LidarObjects::kPoses}), 2);
  EXPECT_THAT(frame.motions, IsEmpty());
  ASSERT_EQ(frame.poses.size(), 2u);
  EXPECT_EQ(frame.poses[1].id, 9);
  EXPECT_EQ(frame.poses[1].T_W_B.translation, Eigen::Vector3d(-4, 0, 8));
  const auto none = Open({.objects = LidarObjects::kNone});
  EXPECT_THAT(FrameOf(none, 2).motions, IsEmpty());
  EXPECT_THAT(FrameOf(none, 2).poses, IsEmpty());
}

TEST_F(Dynosam, ObjectPosesAreBoxesWithoutASize) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->boxes.size(), 4u);
  EXPECT_EQ(dut->boxes[2].frame, 3);
  EXPECT_EQ(dut->boxes[2].id, 7);
  EXPECT_EQ(dut->boxes[2].T_W_B.translation, Eigen::Vector3d(1.4, 0, 5));
  EXPECT_TRUE(dut->boxes[2].size_m.isZero());
}

TEST_F(Dynosam, StampsAreOfTheLogOrAListOrAPeriod) {
  EXPECT_EQ(Open({.frame_period = std::chrono::milliseconds(50)})->poses[2].stamp, At_ms(150));
  folder_.Write("frame_id_timestamp.csv", "frame_id,timestamp [ns]\n1,7\n2,8\n3,9\n4,10");
  EXPECT_EQ(Open()->poses[2].stamp, TimeFromNanoseconds(9));
  folder_.Write(Name("camera_pose"), DynosamLog(kDynosamStampedCamera,
                                                {"1305031102160407000,1,0,0,0.1,0,0,0,1",
                                                 "1305031102260407001,2,0,0,0.2,0,0,0,1"},
                                                kDynosamTruth));
  folder_.Write(Name("object_motion"),
                DynosamLog(kDynosamStampedObject, {"1305031102260407001,2,7,0.2,0,0,0,0,0,1"},
                           kDynosamTruth));
  const auto dut = Open();
  EXPECT_EQ(FrameOf(dut, 1).stamp, TimeFromNanoseconds(1'305'031'102'260'407'001));
  EXPECT_EQ(FrameOf(dut, 1).motions[0].from, TimeFromNanoseconds(1'305'031'102'160'407'000));
  EXPECT_THAT(dut->frames.description,  // a point and two poses of frame 3
              HasSubstr("3 rows of frames without a camera pose are left out"));
}

TEST_F(Dynosam, LinesMayEndAndBeOfWindows) {
  folder_.Write(Name("map_points"), absl::StrCat(kDynosamPoints, "\r\n1,7,21,1,0.5,5.1\r\n"));
  EXPECT_EQ(FrameOf(Open(), 0).points_S.size(), 1u);
  folder_.Write(Name("map_points"), absl::StrCat(kDynosamPoints, "\n"));  // the new front end's
  EXPECT_THAT(FrameOf(Open(), 0).points_S, IsEmpty());
}

TEST_F(Dynosam, APartOfTheFrames) {
  const auto dut = Open({.first_frame = 2, .last_frame = 2});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 1u);
  EXPECT_EQ(dut->poses.size(), 3u);
  const Frame frame = FrameOf(dut, 0);
  EXPECT_THAT(frame.labels, ElementsAre(7, 0, 0));  // with the static point of no frame
  EXPECT_EQ(frame.motions.size(), 1u);              // frame 1 is known, if not sent
}

TEST_F(Dynosam, TheBackEndIsPreferredOrAModuleIsNamed) {
  WriteModule("frontend");
  EXPECT_THAT(Open()->frames.description, HasSubstr("rgbd_motion_world_backend_*"));
  const auto named = OpenDynosam(folder_ / "frontend_camera_pose_log.csv");
  ASSERT_TRUE(named.ok()) << named.status();
  EXPECT_THAT(named->frames.description, HasSubstr("frontend_*"));
  WriteModule("hybrid_backend");
  EXPECT_TRUE(IsDynosam(folder_.path()));
  EXPECT_THAT(std::string(Open().status().message()),
              HasSubstr("several modules, hybrid_backend, rgbd_motion_world_backend; name one"));
}

TEST_F(Dynosam, MotionsThatTurnTooFarAreForTheSceneToName) {
  folder_.Write(Name("object_motion"), DynosamObjectLog({"2,7,0.2,0,0,0,0,1,0.01"}));
  const auto dut = Open();
  ASSERT_EQ(FrameOf(dut, 1).motions.size(), 1u);
  EXPECT_EQ(FrameOf(dut, 1).motions[0].id, 7);
}

// Object 8 is there in frames 1 and 3.
TEST_F(Dynosam, AfterAGapAMotionBeginsAtTheLastPose) {
  folder_.Write(Name("object_pose"),
                DynosamObjectLog({"1,8,1,0,5,0,0,0,1", "3,8,1.4,0,5,0,0,0,1"}));
  folder_.Write(Name("object_motion"), DynosamObjectLog({"2,7,0.2,0,0,0,0,0,1"}));
  const auto dut = Open();
  const Frame frame = FrameOf(dut, 2);
  ASSERT_EQ(frame.motions.size(), 1u);
  EXPECT_EQ(frame.motions[0].id, 8);
  EXPECT_EQ(frame.motions[0].from, dut->poses[0].stamp);
  EXPECT_TRUE(frame.motions[0].H_W.translation.isApprox(Eigen::Vector3d(0.4, 0, 0), 1e-9));
}

// The log's motion of frame 3 starts at a frame that no scene saw.
TEST_F(Dynosam, AfterAFrameThatIsLeftOutAMotionBeginsAtTheLastPose) {
  folder_.Write(Name("camera_pose"),
                DynosamCameraLog({"1,0,0,0.1,0,0,0,1", "2,0,0,3e6,0,0,0,1", "3,0,0,0.3,0,0,0,1"}));
  const auto opened = Open();
  ASSERT_TRUE(opened.ok()) << opened.status();
  const auto dut = WithinScene(*opened);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 2u);
  const Frame frame = FrameOf(dut, 1);
  ASSERT_EQ(frame.motions.size(), 1u);
  EXPECT_EQ(frame.motions[0].id, 7);
  EXPECT_EQ(frame.motions[0].from, dut->poses[0].stamp);
  EXPECT_TRUE(frame.motions[0].H_W.translation.isApprox(Eigen::Vector3d(0.4, 0, 0), 1e-9));
}

}  // namespace
}  // namespace clearway
