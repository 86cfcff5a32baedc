#include "clearway/io/kitti_tracking.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kCalibration[] =
    "P0: 700 0 600 0 0 700 180 0 0 0 1 0\n"
    "P2: 700 0 600 0 0 700 180 0 0 0 1 0\n"
    "R_rect 1 0 0 0 1 0 0 0 1\n"
    "Tr_velo_cam 0 -1 0 0 0 0 -1 -0.08 1 0 0 -0.27\n"
    "Tr_imu_velo 1 0 0 -0.81 0 1 0 0.32 0 0 1 -0.8\n";
// A van whose middle is at (10, 2, -1) of the velodyne, where it looks, in both frames.
constexpr char kLabels[] =
    "0 0 Van 0 0 -1.57 400 150 500 250 2 2 4 -2 1.92 9.73 -1.5707963267949\n"
    "0 -1 DontCare -1 -1 -10 830 200 850 240 -1000 -1000 -1000 -10 -1 -1 -1\n"
    "1 0 Van 0 0 -1.57 400 150 500 250 2 2 4 -2 1.92 9.73 -1.5707963267949\n"
    "1 7 Cyclist 0 0 -1.57 400 150 500 250 2 1 2 0 1.92 19.73 0\n";
constexpr double kLatitude_deg = 49, kRadius_m = 6378137;
const Eigen::Vector3d kSensorInImu(0.81, -0.32, 0.8);

std::string Oxts(double east_m, double yaw_rad) {
  const double radius_m = kRadius_m * std::cos(kLatitude_deg * std::numbers::pi / 180);
  std::string line = absl::StrFormat("%.17g %.17g 112.8 0 0 %.17g", kLatitude_deg,
                                     8.4 + east_m / radius_m * 180 / std::numbers::pi, yaw_rad);
  for (int i = 6; i < 30; ++i) line += " 0";
  return line + "\n";
}

std::string PointBytes(const std::vector<Eigen::Vector4f>& points) {
  std::string bytes;
  for (const Eigen::Vector4f& point : points) {
    bytes.append(reinterpret_cast<const char*>(point.data()), 16);
  }
  return bytes;
}

// Two frames; in between the car goes 1 m east and turns left by a quarter.
class KittiTracking : public testing::Test {
 protected:
  KittiTracking() {
    folder_.Write("calib/0003.txt", kCalibration);
    folder_.Write("label_02/0003.txt", kLabels);
    folder_.Write("oxts/0003.txt", Oxts(0, 0) + Oxts(1, std::numbers::pi / 2));
    folder_.Write("velodyne/0003/000000.bin",
                  PointBytes({{10, 2, -1, 0.5}, {20, 0, -1, 0}, {-5, 0, 0, 0}, {15, -5, -1, 0}}));
    folder_.Write("velodyne/0003/000001.bin",
                  PointBytes({{11.9F, 1.1F, -1.9F, 0}, {12.1F, 2, -1, 0}}));
  }
  absl::StatusOr<LidarFolder> Open(const LidarFolderOptions& options = {}) {
    return OpenKittiTracking(folder_ / "velodyne/0003", options);
  }
  // Of a sequence with that in one of its files.
  std::string ErrorWith(const std::string& file, const std::string& bytes) {
    folder_.Write(file, bytes);
    const auto opened = Open();
    const absl::Status status = opened.ok() ? opened->frames.read(0).status() : opened.status();
    return std::string(status.message());
  }

  // Of the one row that is left out of a sequence with that in one of its files.
  std::string LeftOutWith(const std::string& file, const std::string& bytes) {
    const std::string before = BytesOf(folder_ / file);
    folder_.Write(file, bytes);
    const auto opened = Open();
    folder_.Write(file, before);
    EXPECT_TRUE(opened.ok()) << opened.status();
    if (!opened.ok()) return "";
    EXPECT_EQ(opened->frames.left_out->rows, 1u);
    return opened->frames.left_out->reasons.empty() ? "" : opened->frames.left_out->reasons[0];
  }

  TemporaryFolder folder_;
};

TEST_F(KittiTracking, IsToldByItsFolder) {
  for (const char* name :
       {"velodyne/0003", "velodyne/0003/", "velodyne/0003/.", "calib/../velodyne/0003"}) {
    EXPECT_TRUE(IsKittiTracking(folder_ / name)) << name;
    EXPECT_TRUE(OpenKittiTracking(folder_ / name).ok()) << name;
  }
  EXPECT_FALSE(IsKittiTracking(folder_ / "velodyne"));
  // Of the project's own folders one may be called so.
  EXPECT_FALSE(IsKittiTracking("/nowhere/velodyne/0003"));
}

TEST_F(KittiTracking, PosesAreEastNorthUp) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.sensor_pose_error_m, 1);  // they are of GPS
  ASSERT_EQ(dut->poses.size(), 2u);
  EXPECT_TRUE(dut->poses[0].T_W_S.translation.isApprox(kSensorInImu, 1e-9));
  EXPECT_EQ(dut->poses[1].stamp, TimeFromNanoseconds(100'000'000));
  const Pose& T_W_S = dut->poses[1].T_W_S;
  EXPECT_TRUE((T_W_S * Eigen::Vector3d(2, 0, 0)).isApprox(Eigen::Vector3d(1.32, 2.81, 0.8), 1e-6));
}

TEST_F(KittiTracking, BoxesStandInTheWorld) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->boxes.size(), 3u);
  const RecordedBox& van = dut->boxes[0];
  EXPECT_EQ(van.id, 1);  // track 0
  EXPECT_EQ(van.type, "Van");
  EXPECT_EQ(van.size_m, Eigen::Vector3d(4, 2, 2));
  EXPECT_TRUE(van.T_W_B.translation.isApprox(kSensorInImu + Eigen::Vector3d(10, 2, -1), 1e-9));
  EXPECT_TRUE(van.T_W_B.rotation.toRotationMatrix().isIdentity(1e-9));
  // Not turned, a box looks to the camera's right: here that is east again.
  EXPECT_EQ(dut->boxes[2].id, 8);
  EXPECT_TRUE((dut->boxes[2].T_W_B.rotation * Eigen::Vector3d::UnitX())
                  .isApprox(Eigen::Vector3d::UnitX(), 1e-6));
}

TEST_F(KittiTracking, PointsAreTheirBoxesOrLeftOutWhereNothingIsLabelled) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto first = dut->frames.read(0);
  ASSERT_TRUE(first.ok()) << first.status();
  // In the van, ahead, behind the camera, and in a region that is not labelled.
  EXPECT_EQ(first->labels, (std::vector<ObjectId>{1, 0, kIgnoreLabel, kIgnoreLabel}));
  EXPECT_EQ(first->points_S[1], Eigen::Vector3f(20, 0, -1));
  EXPECT_TRUE(Validate(*first, {}).ok());
  const auto second = dut->frames.read(1);
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_EQ(second->labels, (std::vector<ObjectId>{1, 0}));  // just in it and just not
  ASSERT_EQ(second->motions.size(), 1u);
  const Eigen::Vector3d p_S(10, 2, -1);
  EXPECT_TRUE((second->motions[0].H_W * (dut->poses[0].T_W_S * p_S))
                  .isApprox(dut->poses[1].T_W_S * p_S, 1e-9));
}

TEST_F(KittiTracking, ASequenceMayLackScans) {
  std::filesystem::remove(folder_ / "velodyne/0003/000001.bin");
  EXPECT_THAT(std::string(Open().status().message()), HasSubstr("000001.bin"));
  const auto dut = Open({.allow_missing_points = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 2u);
  EXPECT_TRUE(dut->frames.read(1)->points_S.empty());
}

TEST_F(KittiTracking, ATypeMayBeTwoWords) {
  // As KITTI's raw tracklets call it; converters keep it.
  folder_.Write("label_02/0003.txt",
                std::string(kLabels) +
                    "0 1 Person (sitting) 0 0 -1.57 400 150 500 250 2 2 4 -2 1.92 9.73 -1.57\n");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->boxes.size(), 4u);
  EXPECT_EQ(dut->boxes[1].type, "Person (sitting)");
  EXPECT_EQ(dut->boxes[1].size_m, Eigen::Vector3d(4, 2, 2));
  EXPECT_TRUE(
      dut->boxes[1].T_W_B.translation.isApprox(kSensorInImu + Eigen::Vector3d(10, 2, -1), 1e-6));
  EXPECT_TRUE(dut->frames.left_out->Empty());
}

TEST_F(KittiTracking, LeavesBadRowsOutNamingThem) {
  const std::string labels = kLabels, file = "label_02/0003.txt";
  EXPECT_THAT(LeftOutWith(file, labels + "1 0\n"), HasSubstr("line 5: 2 words, expected 17"));
  EXPECT_THAT(LeftOutWith(file, labels + labels.substr(0, labels.find('\n') + 1)),
              HasSubstr("0003.txt, line 5: a second box of track 0 in frame 0; the first: line 1"));
  EXPECT_THAT(LeftOutWith(file, absl::StrReplaceAll(labels, {{"2 1 2", "2 0 2"}})),
              HasSubstr("line 4, word 12: '0' is not a length above 0"));
  EXPECT_THAT(LeftOutWith(file, absl::StrReplaceAll(labels, {{"1 7 ", "1 -7 "}})),
              HasSubstr("word 2: '-7'"));
  const char kShifted[] = "1 9 Person_(sitting) 7 0 0 -1.57 400 150 500 250 2 2 4 -2 2 9 -1.57\n";
  EXPECT_THAT(LeftOutWith(file, labels + kShifted),
              HasSubstr("line 5, word 11: '250' is not a length above 0, at most 100 m"));
  EXPECT_THAT(LeftOutWith(file, absl::StrReplaceAll(labels, {{"Cyclist 0", "Cyclist 3"}})),
              HasSubstr("line 4, word 4: '3' is not a truncation of -1 to 2"));
  EXPECT_THAT(LeftOutWith(file, labels + "1 9 Car 0 0 -1.57 4 1 5 2 2 2 4 -2 2 9 -90\n"),
              HasSubstr("line 5, word 17: '-90' is not an angle of -2 pi to 2 pi, in rad"));
  // Columns that nothing is read from are checked, too, or shifted ones would pass.
  EXPECT_THAT(LeftOutWith(file, labels + "1 9 A bus 0 -1.57 4 1 5 2 2 2 4 -2 2 9 -1.57\n"),
              HasSubstr("line 5, word 4: 'bus' is not a number"));
  EXPECT_THAT(LeftOutWith(file, absl::StrReplaceAll(labels, {{"0 -1 Dont", "0 no Dont"}})),
              HasSubstr("line 2, word 2: 'no' is not a number"));
}

TEST_F(KittiTracking, FramesWithoutAPoseAreLeftOut) {
  const std::string lost = "49 8.4 nan nan nan nan\n";
  folder_.Write("oxts/0003.txt", lost + Oxts(1, 0));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->poses.size(), 1u);
  EXPECT_EQ(dut->poses[0].frame, 1);
  EXPECT_EQ(dut->poses[0].stamp, TimeFromNanoseconds(100'000'000));
  EXPECT_THAT(dut->frames.left_out->reasons,
              ElementsAre(HasSubstr("oxts/0003.txt, line 1, word 3: 'nan'"),
                          HasSubstr("label_02/0003.txt, line 1: frame 0 has no pose in oxts"),
                          HasSubstr("0003/000000.bin: no usable pose in 0003.txt")));
}

TEST_F(KittiTracking, ScansBehindTheLastPoseAreLeftOutAndNamed) {
  folder_.Write("velodyne/0003/000002.bin", PointBytes({}));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 2u);
  EXPECT_EQ(dut->frames.left_out->frames, 1u);
  EXPECT_THAT(dut->frames.left_out->reasons,
              ElementsAre(HasSubstr("0003/000002.bin: no usable pose in 0003.txt")));
}

TEST_F(KittiTracking, AnEmptyLineOfOxtsIsAFrameWithoutAPose) {
  folder_.Write("oxts/0003.txt", absl::StrCat("\n", Oxts(1, 0)));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->poses.size(), 1u);
  EXPECT_EQ(dut->poses[0].frame, 1);
  EXPECT_TRUE(dut->poses[0].T_W_S.translation.isApprox(kSensorInImu, 1e-9));
  EXPECT_EQ(dut->frames.left_out->rows, 2u);  // its box, too
  EXPECT_THAT(dut->frames.left_out->reasons[0],
              HasSubstr("oxts/0003.txt, line 1: the line is empty, so its frame is left out"));
  // What then comes is still of another format.
  EXPECT_THAT(ErrorWith("oxts/0003.txt", "\n1 2 3\n" + Oxts(1, 0)), HasSubstr("line 2: 3 words"));
}

TEST_F(KittiTracking, SaysWhatIsWrongWhere) {
  EXPECT_THAT(ErrorWith("velodyne/0003/000000.bin", "123"), HasSubstr("3 bytes"));
  EXPECT_THAT(ErrorWith("calib/0003.txt", "P2: 1 2 3\n"), HasSubstr("line 1: 4 words"));
  EXPECT_THAT(ErrorWith("calib/0003.txt", "P1: 1\n"), HasSubstr("no P2"));
  EXPECT_THAT(ErrorWith("calib/0003.txt",
                        absl::StrReplaceAll(kCalibration, {{"cam 0 -1 0 0", "cam 0 -2 0 0"}})),
              HasSubstr("Tr_velo_cam: not a rotation"));
  EXPECT_THAT(
      ErrorWith("calib/0003.txt", absl::StrReplaceAll(kCalibration, {{"P2: 700", "P2: 0"}})),
      HasSubstr("P2: is not the projection of a camera"));
  EXPECT_THAT(ErrorWith("calib/0003.txt",
                        kCalibration + std::string("P2: 701 0 600 0 0 700 180 0 0 0 1 0\n")),
              HasSubstr("line 6: a second P2 of other values; the first: line 2"));
  EXPECT_THAT(ErrorWith("calib/0003.txt",  // as the other benchmark spells it
                        kCalibration + std::string("R0_rect: 1 0 0 0 1 0 0 0 1.01\n")),
              HasSubstr("line 6: a second R_rect of other values; the first: line 3"));
  folder_.Write("calib/0003.txt", kCalibration);
  EXPECT_THAT(ErrorWith("oxts/0003.txt", ""), HasSubstr("no frame"));
  EXPECT_THAT(ErrorWith("oxts/0003.txt", "1 2 3\n"), HasSubstr("line 1: 3 words"));
  EXPECT_THAT(ErrorWith("oxts/0003.txt", "91 8 100 0 0 0\n"), HasSubstr("word 1: '91'"));
  EXPECT_THAT(ErrorWith("oxts/0003.txt", "49 8 nan 0 0 0\n"), HasSubstr("word 3: 'nan'"));
  EXPECT_THAT(ErrorWith("oxts/0003.txt", "49 8 1e308 0 0 0\n"), HasSubstr("word 3: '1e308'"));
  folder_.Write("oxts/0003.txt", Oxts(0, 0) + Oxts(1, 0));
  EXPECT_THAT(ErrorWith("label_02/0003.txt", absl::StrReplaceAll(kLabels, {{"0 0 Van", "7 0 Van"},
                                                                           {"1 0 Van", "8 0 Van"},
                                                                           {"1 7 ", "9 7 "}})),
              HasSubstr("line 1: frame 7 has no pose in oxts; nor has any other box"));
  const std::string labels = kLabels;
  EXPECT_THAT(ErrorWith("label_02/0003.txt", "1 0\n" + labels), HasSubstr("line 1: 2 words"));
  EXPECT_THAT(ErrorWith("label_02/0003.txt", labels.substr(0, 100)), HasSubstr("cut off"));
  folder_.Write("label_02/0003.txt", labels);
  const auto icp = Open({.poses = LidarPoses::kIcp});
  EXPECT_EQ(icp.status().code(), absl::StatusCode::kInvalidArgument);
  std::filesystem::remove(folder_ / "label_02/0003.txt");
  EXPECT_EQ(Open().status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(Open().status().message()), HasSubstr("without labels"));
}

}  // namespace
}  // namespace clearway
