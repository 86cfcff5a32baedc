// Sequences of KITTI's odometry benchmark with SemanticKITTI's labels.
#include "clearway/io/kitti_odometry.h"

#include <gmock/gmock.h>

#include "absl/strings/str_cat.h"
#include "io/pcd_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

// The velodyne (x forward, z up) in the camera (z forward, y down), which is 0.3 m before it.
constexpr char kCalib[] = "P0: 718 0 607 0 0 718 185 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n";
// The camera goes 1 m along its z, and then turns by a quarter to the right (about y).
constexpr char kPoses[] =
    "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n0 0 1 0 0 1 0 0 -1 0 0 1\n";

std::string PointsOf(std::initializer_list<Eigen::Vector3f> points) {
  std::string bytes;
  for (const Eigen::Vector3f& p : points) {
    for (const float value : {p.x(), p.y(), p.z(), 0.5f}) PutBytes(bytes, value);
  }
  return bytes;
}

std::string LabelsOf(std::initializer_list<std::uint32_t> labels) {
  std::string bytes;
  for (const std::uint32_t label : labels) PutBytes(bytes, label);
  return bytes;
}

constexpr std::uint32_t Label(std::uint32_t label_class, std::uint32_t instance) {
  return instance << 16 | label_class;
}

class KittiOdometry : public testing::Test {
 protected:
  KittiOdometry() {
    Write("calib.txt", kCalib);
    Write("poses.txt", kPoses);
    Write("times.txt", "0.000000e+00\n1.037359e-01\n2.075000e-01\n");
    for (const char* name : {"000000", "000001", "000002"}) {
      Write(absl::StrCat("velodyne/", name, ".bin"), PointsOf({{5, 0, 0}, {0, 3, 1}, {8, 8, 1}}));
    }
  }
  std::filesystem::path Write(const std::string& name, const std::string& text) {
    return folder_.Write("sequences/08/" + name, text);
  }
  void WriteLabels() {
    for (const char* name : {"000000", "000001", "000002"}) {
      Write(absl::StrCat("labels/", name, ".label"),
            LabelsOf({Label(40, 0), Label(252, 5), Label(10, 9)}));
    }
  }
  absl::StatusOr<LidarFolder> Open(const KittiOdometryOptions& options = {}) {
    return OpenKittiOdometry(folder_ / "sequences/08", options);
  }
  std::string ErrorOf() {
    const auto opened = Open();
    EXPECT_FALSE(opened.ok());
    return std::string(opened.status().message());
  }

  TemporaryFolder folder_;
};

TEST_F(KittiOdometry, Empty) {
  EXPECT_TRUE(IsKittiOdometry(folder_ / "sequences/08"));
  EXPECT_FALSE(IsKittiOdometry(folder_ / "sequences"));
  const TemporaryFolder empty;
  EXPECT_FALSE(IsKittiOdometry(empty.path()));
}

TEST_F(KittiOdometry, PosesAreTheVelodynesInAWorldWhoseZIsUp) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->frames.frame_count, 3u);
  const auto first = dut->frames.read(0), second = dut->frames.read(1), third = dut->frames.read(2);
  EXPECT_TRUE(first->T_W_S.translation.isZero(1e-12));
  EXPECT_TRUE(second->T_W_S.translation.isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  // The camera is 0.3 m before the velodyne, and turns it to the right about itself.
  EXPECT_TRUE(third->T_W_S.translation.isApprox(Eigen::Vector3d(1.3, 0.3, 0), 1e-12))
      << third->T_W_S.translation.transpose();
  EXPECT_TRUE((third->T_W_S * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1.3, -0.7, 0)));
  EXPECT_EQ(second->stamp, TimeFromNanoseconds(103'735'900));
  EXPECT_EQ(second->points_S[1], Eigen::Vector3f(0, 3, 1));
  EXPECT_EQ(second->sequence, 1u);
}

TEST_F(KittiOdometry, WithoutLabelsAllIsStatic) {
  const auto dut = Open();
  EXPECT_THAT(dut->frames.read(0)->labels, ElementsAre(0, 0, 0));
  EXPECT_THAT(dut->frames.description, HasSubstr("no folder labels: all points are static"));
}

TEST_F(KittiOdometry, WhatMovesIsAnObject) {
  WriteLabels();
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto frame = dut->frames.read(1);
  EXPECT_THAT(frame->labels, ElementsAre(0, 100'005, 0));
  EXPECT_TRUE(frame->motions.empty());
  EXPECT_TRUE(frame->poses.empty());
  const auto parked = Open({{}, ParkedObjects::kObjects});
  EXPECT_THAT(parked->frames.read(1)->labels, ElementsAre(0, 100'005, 100'009));
}

TEST(SemanticKitti, EveryClass) {
  constexpr auto kStatic = ParkedObjects::kStatic, kObjects = ParkedObjects::kObjects;
  constexpr std::uint32_t kParked[] = {10, 31, 30, 32, 16, 13, 18, 20};
  for (std::uint32_t k = 0; k < 8; ++k) {
    const auto id = static_cast<ObjectId>(100'000 * (k + 1) + 65'535);
    EXPECT_EQ(SemanticKittiObject(Label(252 + k, 65'535), kStatic), id) << k;
    EXPECT_EQ(SemanticKittiObject(Label(252 + k, 65'535), kObjects), id) << k;
    EXPECT_EQ(SemanticKittiObject(Label(252 + k, 0), kStatic), kIgnoreLabel) << k;
    EXPECT_EQ(SemanticKittiObject(Label(kParked[k], 65'535), kStatic), kStaticLabel) << k;
    EXPECT_EQ(SemanticKittiObject(Label(kParked[k], 65'535), kObjects), id) << k;
    EXPECT_EQ(SemanticKittiObject(Label(kParked[k], 0), kObjects), kStaticLabel) << k;
  }
  for (const auto parked : {kStatic, kObjects}) {
    EXPECT_EQ(SemanticKittiObject(Label(0, 3), parked), kIgnoreLabel);
    EXPECT_EQ(SemanticKittiObject(Label(1, 3), parked), kIgnoreLabel);
    EXPECT_EQ(SemanticKittiObject(Label(40, 3), parked), kStaticLabel);
    EXPECT_EQ(SemanticKittiObject(Label(99, 0), parked), kStaticLabel);
  }
}

TEST_F(KittiOdometry, PosesAsTheBenchmarkPublishesThem) {
  std::filesystem::remove(folder_ / "sequences/08/poses.txt");
  EXPECT_THAT(ErrorOf(), AllOf(HasSubstr("08/poses.txt: no such file, nor"),
                               HasSubstr("poses/08.txt; the testing half of KITTI has no poses")));
  folder_.Write("poses/08.txt", kPoses);
  EXPECT_TRUE(Open().ok());
  EXPECT_TRUE(OpenKittiOdometry(folder_.path().string() + "/sequences/08/").ok());
}

TEST_F(KittiOdometry, WithoutTimesFramesAreATenthOfASecondApart) {
  std::filesystem::remove(folder_ / "sequences/08/times.txt");
  EXPECT_EQ(Open()->frames.read(2)->stamp, TimeFromNanoseconds(200'000'000));
}

TEST_F(KittiOdometry, AScanWithoutAPoseIsLeftOutAndNamed) {
  Write("velodyne/000003.bin", PointsOf({{1, 1, 1}}));
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 3u);
  EXPECT_EQ(dut->frames.left_out->frames, 1u);
  EXPECT_THAT(dut->frames.left_out->reasons,
              ElementsAre(HasSubstr("velodyne/000003.bin: no usable pose in poses.txt")));
}

// Lines are numbered by the scans: without the empty one, every later scan would have its
// predecessor's pose.
TEST_F(KittiOdometry, AnEmptyLineOfPosesIsThatOfAScan) {
  Write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n\n0 0 1 0 0 1 0 0 -1 0 0 1\n");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->frames.frame_count, 2u);
  EXPECT_EQ(dut->frames.read(1)->stamp, TimeFromNanoseconds(207'500'000));
  EXPECT_THAT(dut->frames.left_out->reasons,
              UnorderedElementsAre(
                  HasSubstr("08/poses.txt, line 2: the line is empty, so its frame is left out"),
                  HasSubstr("velodyne/000001.bin: no usable pose in poses.txt")));
}

TEST_F(KittiOdometry, AnEmptyLineOfTimesIsThatOfAPose) {
  Write("times.txt", "0.0\n\n0.2\n");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->frames.frame_count, 2u);
  EXPECT_EQ(dut->frames.read(1)->stamp, TimeFromNanoseconds(200'000'000));
  EXPECT_THAT(dut->frames.left_out->reasons,
              Contains(HasSubstr("08/times.txt, line 2: the line is empty")));
}

TEST_F(KittiOdometry, AStampThatDoesNotAscendIsNamedWithItsLine) {
  Write("poses.txt", std::string("# of the left camera\n") + kPoses);
  Write("times.txt", "0.0\n0.3\n0.2\n");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 2u);
  EXPECT_THAT(dut->frames.left_out->reasons[0],
              HasSubstr("08/times.txt, line 2: frame 1 at 300000000 ns: stamps must ascend"));
}

TEST_F(KittiOdometry, Refusals) {
  WriteLabels();
  Write("labels/000001.label", LabelsOf({0, 0}));
  EXPECT_THAT(std::string(Open()->frames.read(1).status().message()),
              HasSubstr("000001.label: 8 bytes; the scan's 3 points need 12"));
  std::filesystem::remove(folder_ / "sequences/08/labels/000001.label");
  EXPECT_TRUE(absl::IsNotFound(Open()->frames.read(1).status()));
  Write("velodyne/000002.bin", "0123456789");
  EXPECT_THAT(std::string(Open()->frames.read(2).status().message()),
              HasSubstr("10 bytes are not a whole number of 16-byte points"));
  std::filesystem::remove(folder_ / "sequences/08/velodyne/000002.bin");
  EXPECT_THAT(ErrorOf(), HasSubstr("1 of 3 frames have a pose but no file of points"));
  EXPECT_TRUE(Open({{.allow_missing_points = true}}).ok());
  Write("calib.txt", "P0: 1\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("calib.txt: no Tr"));
  Write("calib.txt", "Tr: 1 2 3\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("calib.txt, line 1: 4 words, expected a key and 12"));
  Write("calib.txt", std::string(kCalib) + "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.4\n");
  EXPECT_THAT(ErrorOf(),
              HasSubstr("calib.txt, line 3: a second Tr of other values; the first: line 2"));
  Write("calib.txt", std::string(kCalib) + "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n");
  EXPECT_TRUE(Open({{.allow_missing_points = true}}).ok());
  Write("calib.txt", "Tr: 2 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("calib.txt, line 1"));
  Write("calib.txt", kCalib);
  Write("times.txt", "0\n");
  EXPECT_THAT(ErrorOf(), HasSubstr("times.txt: 1 times for the 3 poses"));
}

}  // namespace
}  // namespace clearway
