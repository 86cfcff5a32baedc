#include "clearway/io/tum_rgbd.h"

#include <gmock/gmock.h>

#include <vector>

#include "absl/strings/str_replace.h"
#include "clearway/io/world_origin.h"
#include "io/pcd_example.h"
#include "io/tum_rgbd_example.h"

namespace clearway {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST_F(TumRgbd, IsToldByItsList) {
  EXPECT_TRUE(IsTumRgbd(folder_.path()));
  EXPECT_FALSE(IsTumRgbd(folder_ / "depth"));
  EXPECT_FALSE(IsTumRgbd("/nowhere"));
  EXPECT_TRUE(OpenTumRgbd(folder_ / "").ok());
  EXPECT_TRUE(OpenTumRgbd(folder_ / "depth/..").ok());
}

TEST_F(TumRgbd, DepthsMayBeFloatsInMetres) {
  folder_.Write("depth.txt", absl::StrReplaceAll(kTumDepth, {{"a.png", "a.pfm"}}));
  std::string pfm = "Pf\n4 3\n-1\n";
  // From the bottom up.
  for (const float depth_m : {0.f, 0.f, 0.f, 2.f, 0.f, -1.f, 1.f, 0.f, 1.f, 0.f, 0.f, 0.f}) {
    PutBytes(pfm, depth_m);
  }
  folder_.Write("depth/a.pfm", pfm);
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto metres = dut->frames.read(0);
  ASSERT_TRUE(metres.ok()) << metres.status();
  folder_.Write("depth.txt", kTumDepth);
  EXPECT_EQ(metres->points_S, Open()->frames.read(0)->points_S);
  folder_.Write("depth/a.pfm", pfm.substr(0, 40));
  EXPECT_THAT(std::string(dut->frames.read(0).status().message()), HasSubstr("a.pfm: "));
}

TEST_F(TumRgbd, FarTrajectoriesAreMovedExactly) {
  const std::string far = absl::StrReplaceAll(kTumTrack, {{"0.1100 0 0", "500000.11 4100000 12"},
                                                          {"0.0900 0 0", "500000.09 4100000 12"},
                                                          {"0.1330 0 0", "500000.133 4100000 12"},
                                                          {"0.1500 0 0", "500000.15 4100000 12"},
                                                          {"0.9000 0 0", "500000.9 4100000 12"}});
  const auto near = Open();
  folder_.Write("groundtruth.txt", far);
  EXPECT_TRUE(absl::IsInvalidArgument(WithOrigin(*Open(), std::nullopt).status()));
  const auto dut = WithOrigin(*Open(), WorldOrigin{.position_m = {500'000, 4'100'000, 12}});
  ASSERT_TRUE(dut.ok()) << dut.status();
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(
        (dut->frames.read(k)->T_W_S.translation - near->frames.read(k)->T_W_S.translation).norm(),
        1e-9);
    EXPECT_EQ(dut->frames.read(k)->points_S, near->frames.read(k)->points_S);
  }
}

TEST_F(TumRgbd, PixelsArePointsOfTheOpticalFrame) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 3u);
  EXPECT_EQ(dut->frames.resolution_m, 0.05);
  EXPECT_THAT(dut->frames.description, HasSubstr("no mask.txt: all points are static"));
  const auto frame = dut->frames.read(0);
  ASSERT_TRUE(frame.ok()) << frame.status();
  EXPECT_EQ(frame->sensor_id, "camera");
  EXPECT_EQ(frame->sequence, 0u);
  EXPECT_EQ(frame->stamp, At_ms(100));
  const std::vector<Eigen::Vector3f> expected = {
      {-0.015F, -0.005F, 1}, {0.005F, 0, 1}, {0.03F, 0.01F, 2}};
  ASSERT_EQ(frame->points_S.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(frame->points_S[i].isApprox(expected[i], 1e-6F));
  EXPECT_THAT(frame->labels, ElementsAre(0, 0, 0));
  EXPECT_TRUE(Validate(*frame, {}).ok());
}

TEST_F(TumRgbd, PosesAreInterpolatedOrTheNearest) {
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->poses.size(), 3u);
  EXPECT_NEAR(dut->poses[0].T_W_S.translation.x(), 0.1, 1e-9);  // in the middle of two
  EXPECT_EQ(dut->poses[1].T_W_S.translation.x(), 0.133);        // there is one
  EXPECT_NEAR(dut->poses[1].T_W_S.rotation.norm(), 1, 1e-12);
  EXPECT_EQ(dut->poses[2].T_W_S.translation.x(), 0.15);  // the next one is far away
}

TEST_F(TumRgbd, ImagesWithoutAPoseAreLeftOut) {
  folder_.Write("groundtruth.txt",
                "1305031102.1120 1 2 3 0 0 0 1\n1305031102.1860 4 5 6 0 0 1 0\n");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  // One is 12 ms from a pose, one 21 ms, one 20 ms.
  ASSERT_EQ(dut->poses.size(), 2u);
  EXPECT_EQ(dut->poses[1].frame, 2);
  EXPECT_THAT(dut->frames.description, HasSubstr("of 3 depth images left out: 1 without a pose"));
  EXPECT_EQ(dut->frames.read(1)->sequence, 2u);
  EXPECT_EQ(dut->frames.read(1)->points_S[0].z(), 3);
  folder_.Write("groundtruth.txt", "1.5 1 2 3 0 0 0 1\n");
  EXPECT_THAT(std::string(Open().status().message()), HasSubstr("3 have no pose within 0.02 s"));
}

TEST_F(TumRgbd, MasksAndPosesOfObjects) {
  WriteObjects();
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  const auto first = dut->frames.read(0), second = dut->frames.read(1);
  ASSERT_TRUE(first.ok() && second.ok()) << first.status() << second.status();
  EXPECT_THAT(first->labels, ElementsAre(7, 0, 9));
  EXPECT_TRUE(first->motions.empty());
  ASSERT_EQ(second->motions.size(), 1u);  // of 9 there is no second pose
  EXPECT_EQ(second->motions[0].id, 7);
  EXPECT_EQ(second->motions[0].from, At_ms(100));
  EXPECT_NEAR(second->motions[0].H_W.translation.x(), 0.033, 1e-9);
  EXPECT_EQ(dut->boxes.size(), 4u);
  EXPECT_EQ(dut->frames.description.find("mask"), std::string::npos);
}

TEST_F(TumRgbd, ObjectsAsAskedFor) {
  WriteObjects();
  const auto poses = Open({.objects = LidarObjects::kPoses});
  ASSERT_TRUE(poses.ok()) << poses.status();
  const auto frame = poses->frames.read(1);
  ASSERT_EQ(frame->poses.size(), 1u);
  EXPECT_TRUE(frame->poses[0].T_W_B.translation.isApprox(Eigen::Vector3d(0.033, 0, 2), 1e-9));
  const auto none = Open({.objects = LidarObjects::kNone});
  EXPECT_TRUE(none->frames.read(1)->poses.empty() && none->frames.read(1)->motions.empty());
}

TEST_F(TumRgbd, MasksMayHave16BitsOrAPalette) {
  WriteObjects();
  const std::vector<int> values = {300, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 65'535};
  folder_.Write("mask/a.png", PngBytes(4, 3, values));
  EXPECT_THAT(Open()->frames.read(0)->labels, ElementsAre(300, 1, 65'535));
  folder_.Write("mask/a.png", PngBytes(4, 3, {3, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1},
                                       {.bits = 4, .color_type = PNG_COLOR_TYPE_PALETTE}));
  EXPECT_THAT(Open()->frames.read(0)->labels, ElementsAre(3, 2, 1));
}

TEST_F(TumRgbd, ImagesWithoutAMaskAreLeftOut) {
  WriteObjects();
  folder_.Write("mask.txt", "1305031102.170000 mask/c.png\n");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, 1u);
  EXPECT_THAT(dut->frames.description,
              HasSubstr("0 without a pose within 0.02 s, 2 without a mask"));
}

TEST_F(TumRgbd, OneMaskFileThatIsMissingCostsItsFrame) {
  WriteObjects();
  const std::size_t frames = Open()->frames.frame_count;
  std::filesystem::remove(folder_ / "mask/b.png");
  const auto dut = Open();
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.frame_count, frames - 1);
  EXPECT_EQ(dut->frames.left_out->rows, 1u);
  EXPECT_EQ(dut->frames.left_out->frames, 1u);
  EXPECT_THAT(dut->frames.left_out->reasons[0], HasSubstr("mask/b.png: no such file"));
}

TEST_F(TumRgbd, FewerPixelsAndNearerOnes) {
  EXPECT_EQ(Open({.stride = 2})->frames.read(0)->points_S.size(), 1u);
  EXPECT_EQ(Open({.max_depth_m = 1.5})->frames.read(0)->points_S.size(), 2u);
  EXPECT_THAT(std::string(Open({.stride = 0}).status().message()), HasSubstr("stride: is 0"));
  EXPECT_THAT(std::string(Open({.max_depth_m = -1}).status().message()), HasSubstr("is -1"));
}

// Of the published size: all of it at 1 m.
std::string PublishedDepthPng() { return PngBytes(640, 480, std::vector<int>(640 * 480, 5000)); }

TEST_F(TumRgbd, TheCameraIsWrittenDownOrPublished) {
  folder_.Write("camera.txt", "100 200 1.5 1 1000");  // a depth factor of its own
  EXPECT_EQ(Open()->frames.read(0)->points_S[0].z(), 5);
  std::filesystem::remove(folder_ / "camera.txt");
  EXPECT_TRUE(absl::IsNotFound(Open().status()));
  EXPECT_THAT(std::string(Open().status().message()), HasSubstr("camera.txt"));
  const struct {
    const char* name;
    double fx, fy, cx, cy;
  } published[] = {{"rgbd_dataset_freiburg1_xyz", 517.3, 516.5, 318.6, 255.3},
                   {"rgbd_dataset_freiburg2_desk", 520.9, 521.0, 325.1, 249.7},
                   {"rgbd_dataset_freiburg3_walking_xyz", 535.4, 539.2, 320.1, 247.6}};
  for (const auto& [name, fx, fy, cx, cy] : published) {
    for (const char* image : {"depth/a.png", "depth/b.png", "depth/c.png"}) {
      folder_.Write(image, PublishedDepthPng());
    }
    std::filesystem::copy(folder_.path(),
                          folder_ / ".." / (folder_.path().filename().string() + name),
                          std::filesystem::copy_options::recursive);
    const std::filesystem::path copy = folder_.path().string() + name;
    const auto frame = OpenTumRgbd(copy)->frames.read(0);
    std::filesystem::remove_all(copy);
    ASSERT_TRUE(frame.ok()) << frame.status();
    EXPECT_NEAR(frame->points_S[642].x(), (2 - cx) / fx, 1e-6);
    EXPECT_NEAR(frame->points_S[642].y(), (1 - cy) / fy, 1e-6);
  }
}

TEST_F(TumRgbd, PublishedIntrinsicsAreForImagesOfOneSize) {
  std::filesystem::remove(folder_ / "camera.txt");
  const std::filesystem::path copy = folder_.path().string() + "freiburg1";
  std::filesystem::copy(folder_.path(), copy, std::filesystem::copy_options::recursive);
  const absl::Status status = OpenTumRgbd(copy).status();
  std::filesystem::remove_all(copy);
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_THAT(std::string(status.message()),
              AllOf(HasSubstr("4 x 3 pixels; the intrinsics published"),
                    HasSubstr("are for 640 x 480; write those of these images to")));
}

TEST_F(TumRgbd, StampsAreExact) {
  folder_.Write("depth.txt", absl::StrReplaceAll(kTumDepth, {{".100000", ".100000001"}}));
  EXPECT_EQ(Open()->poses[0].stamp, At_ms(100) + Duration(1));
  folder_.Write("depth.txt", "1.3050311021e+09 depth/a.png\n");
  EXPECT_LE(std::chrono::abs(Open()->poses[0].stamp - At_ms(100)), Duration(200));
}

TEST_F(TumRgbd, MayLackImages) {
  std::filesystem::remove(folder_ / "depth/b.png");
  const auto dut = Open({.allow_missing_points = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(1)->points_S.empty());
}

}  // namespace
}  // namespace clearway
