#include "clearway/io/cluster_slam.h"

#include <gmock/gmock.h>

#include "io/cluster_slam_example.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kWritten_m = 1e-3;  // pixels have five decimals

TEST_F(ClusterSlam, IsToldByItsFiles) {
  EXPECT_TRUE(IsClusterSlam(folder_.path()));
  EXPECT_FALSE(IsClusterSlam(folder_ / "pose"));
  EXPECT_FALSE(IsClusterSlam("/nowhere"));
}

TEST_F(ClusterSlam, LandmarksAreTriangulated) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->frames.frame_count, std::size_t{kFrames});
  for (int k = 0; k < kFrames; ++k) {
    const auto frame = dut->frames.read(k);
    ASSERT_TRUE(frame.ok()) << frame.status();
    EXPECT_EQ(frame->sequence, std::uint64_t(k));
    EXPECT_EQ(ToNanoseconds(frame->stamp), 100'000'000 * k);
    EXPECT_TRUE(Validate(*frame, {}).ok());
    ASSERT_EQ(frame->points_S.size(), std::size_t{kStatic + kMoving});
    for (int i = 0; i < kStatic + kMoving; ++i) {
      const bool moves = i >= kStatic;
      const Eigen::Vector3d p_W =
          moves ? Cluster(k) * MovingPoint_B(i - kStatic) : StaticPoint_W(i);
      EXPECT_EQ(frame->labels[i], moves ? 1 : 0);
      EXPECT_LT((frame->T_W_S * frame->points_S[i].cast<double>() - p_W).norm(), kWritten_m);
    }
  }
}

TEST_F(ClusterSlam, ClustersMove) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto frame = dut->frames.read(3);
  ASSERT_EQ(frame->motions.size(), 2u);
  EXPECT_EQ(frame->motions[0].id, 1);
  EXPECT_EQ(ToNanoseconds(frame->motions[0].from), 200'000'000);
  for (int i = 0; i < kMoving; ++i) {
    const Eigen::Vector3d p_B = MovingPoint_B(i);
    EXPECT_LT((frame->motions[0].H_W * (Cluster(2) * p_B) - Cluster(3) * p_B).norm(), 1e-6);
  }
  EXPECT_EQ(dut->boxes.size(), std::size_t{2 * kFrames});
  EXPECT_TRUE(dut->boxes[0].size_m.isZero());
  EXPECT_EQ(Open({.objects = LidarObjects::kPoses})->frames.read(3)->poses.size(), 2u);
}

TEST_F(ClusterSlam, TheOrderOfQuaternionsIsFound) {
  for (const bool w_first : {true, false}) {
    Write(w_first);
    const auto dut = Open();
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_THAT(dut->frames.description,
                HasSubstr(w_first ? "quaternions are w, x, y, z" : "quaternions are x, y, z, w"));
    EXPECT_THAT(dut->frames.description,
                HasSubstr("landmarks are seen 0.0 pixels from where poses put them, those that"));
    EXPECT_TRUE(dut->poses[5].T_W_S.rotation.isApprox(Camera(5).rotation, 1e-6));
  }
}

TEST_F(ClusterSlam, OneFrameTellsNoOrder) {
  for (int k = 1; k < kFrames; ++k) {
    std::filesystem::remove(folder_ / absl::StrFormat("pose/%04d.txt", k));
  }
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 1u);
  EXPECT_THAT(dut->frames.description,
              HasSubstr("quaternions are taken for w, x, y, z (too few static landmarks to tell); "
                        "frames of landmarks without poses, left out: 7"));
  EXPECT_EQ(dut->frames.left_out->frames, 7u);
  EXPECT_THAT(dut->frames.left_out->reasons[0],
              HasSubstr("landmarks/left/0001.txt: no usable pose in pose"));
  EXPECT_THAT(dut->frames.description, Not(HasSubstr("pixels")));
}

TEST_F(ClusterSlam, ClustersWithoutPosesAreTold) {
  EXPECT_THAT(Open()->frames.description, Not(HasSubstr("without poses")));
  const std::string mapping = BytesOf(folder_ / "landmark_mapping.txt");
  folder_.Write("landmark_mapping.txt", mapping + "300 99\n301 3\n302 99\n");
  EXPECT_THAT(Open()->frames.description,
              HasSubstr("; clusters of landmark_mapping.txt without poses: 2"));
}

TEST_F(ClusterSlam, WhatOneCameraSeesOrNobodyClusteredIsNoPoint) {
  folder_.Write("landmarks/left/0000.txt", "100 320 240\n101 330 240\n300 350 240\n");
  folder_.Write("landmarks/right/0000.txt", "101 305 240\n300 325 240\n102 300 240\n");
  const auto frame = Open({.objects = LidarObjects::kNone})->frames.read(0);
  ASSERT_TRUE(frame.ok()) << frame.status();
  ASSERT_EQ(frame->points_S.size(), 2u);
  EXPECT_TRUE(frame->points_S[0].isApprox(Eigen::Vector3f(0.2F, 0, 10), 1e-5F));
  EXPECT_THAT(frame->labels, ::testing::ElementsAre(0, -1));
}

TEST_F(ClusterSlam, WhatIsTooFarIsNoPoint) {
  folder_.Write("landmarks/left/0000.txt", "100 320 240\n101 320 240\n102 320 240\n103 320 240\n");
  folder_.Write("landmarks/right/0000.txt",
                "100 319.5 240\n101 321 240\n102 318.5 240\n103 300 240\n");
  EXPECT_EQ(Open()->frames.read(0)->points_S.size(), 2u);
  const auto frame = Open({.max_depth_m = 20})->frames.read(0);
  ASSERT_EQ(frame->points_S.size(), 1u);
  EXPECT_NEAR(frame->points_S[0].z(), 12.5, 1e-4);
}

TEST_F(ClusterSlam, PosesThatDoNotFitAreRefused) {
  // Of the clusters: as if they turned about another axis.
  Write(true, [](int k) {
    return Pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.9 + 0.1 * k, Eigen::Vector3d::UnitX())),
                Cluster(k).translation};
  });
  const absl::Status status = Open().status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_THAT(std::string(status.message()),
              AllOf(HasSubstr("landmarks of moving clusters are seen"),
                    HasSubstr("(--objects none goes on without")));
  EXPECT_TRUE(Open({.objects = LidarObjects::kNone}).ok());
  // Of the camera: as if it went backwards.
  for (int k = 0; k < kFrames; ++k) {
    folder_.Write(absl::StrFormat("pose/%04d.txt", k),
                  BytesOf(folder_ / absl::StrFormat("pose/%04d.txt", kFrames - 1 - k)));
    if (k < kFrames / 2) continue;
    folder_.Write(absl::StrFormat("pose/%04d.txt", k),
                  "0 0 -5 0.6 0 0.8 0\n0 0 0 1 0 0 0\n0 0 0 1 0 0 0\n");
  }
  EXPECT_THAT(std::string(Open({.objects = LidarObjects::kNone}).status().message()),
              HasSubstr("static landmarks are seen"));
}

TEST_F(ClusterSlam, OtherChoices) {
  EXPECT_EQ(ToNanoseconds(Open({.frame_period = std::chrono::milliseconds(40)})->poses[2].stamp),
            80'000'000);
  EXPECT_THAT(std::string(Open({.frame_period = Duration::zero()}).status().message()),
              HasSubstr("frame_period: is 0 ns"));
  std::filesystem::rename(folder_ / "intrinsic.txt", folder_ / "instrinsic.txt");
  EXPECT_TRUE(Open().ok());
  for (const char* side : {"left", "right"}) {
    const std::filesystem::path file = folder_ / absl::StrCat("landmarks/", side, "/0002.txt");
    const std::string before = BytesOf(file);
    std::filesystem::remove(file);
    EXPECT_TRUE(absl::IsNotFound(Open().status())) << Open().status();
    const auto dut = Open({.allow_missing_points = true});
    ASSERT_TRUE(dut.ok()) << dut.status();
    EXPECT_TRUE(dut->frames.read(2)->points_S.empty());
    folder_.Write(absl::StrCat("landmarks/", side, "/0002.txt"), before);
  }
}

}  // namespace
}  // namespace clearway
