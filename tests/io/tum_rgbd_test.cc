#include "clearway/io/tum_rgbd.h"

#include <gmock/gmock.h>

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "io/png_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// As published: comments above the rows.
constexpr char kDepth[] =
    "# depth maps\n# file: 'rgbd_dataset_freiburg9_test.bag'\n# timestamp filename\n"
    "1305031102.100000 depth/a.png\n"
    "1305031102.133000 depth/b.png\n"
    "1305031102.166000 depth/c.png\n";
// The camera goes 1 m/s along W's x and looks along W's z; the last poses come late.
constexpr char kTrack[] =
    "# ground truth trajectory\n# timestamp tx ty tz qx qy qz qw\n"
    "1305031102.0900 0.0900 0 0 0 0 0 1\n"
    "1305031102.1100 0.1100 0 0 0 0 0 1\n"
    "1305031102.1330 0.1330 0 0 0 0 0.0001 1.0001\n"
    "1305031102.1500 0.1500 0 0 0 0 0 1\n"
    "1305031102.9000 0.9000 0 0 0 0 0 1\n";
constexpr char kCamera[] = "# fx fy cx cy\n100 200 1.5 1\n";
constexpr char kMasks[] =
    "1305031102.105000 mask/a.png\n1305031102.140000 mask/b.png\n1305031102.170000 mask/c.png\n";
constexpr char kObjects[] =
    "# timestamp id tx ty tz qx qy qz qw\n"
    "1305031102.1000 7 0 0 2 0 0 0 1\n"
    "1305031102.1000 9 5 0 2 0 0 0 1\n"
    "1305031102.1230 7 0.023 0 2 0 0 0 1\n"
    "1305031102.1430 7 0.043 0 2 0 0 0 1\n"
    "1305031102.1660 7 0.066 0 2 0 0 0 1\n";
constexpr std::int64_t kStart_ns = 1'305'031'102'000'000'000;

Time At_ms(std::int64_t ms) { return TimeFromNanoseconds(kStart_ns + ms * 1'000'000); }

std::string DepthPng(int count) {
  return PngBytes(4, 3, {count, 0, 0, 0, 0, 0, count, 0, 0, 0, 0, 2 * count});
}

class TumRgbd : public testing::Test {
 protected:
  TumRgbd() {
    folder_.Write("depth.txt", kDepth);
    folder_.Write("groundtruth.txt", kTrack);
    folder_.Write("camera.txt", kCamera);
    folder_.Write("depth/a.png", DepthPng(5000));
    folder_.Write("depth/b.png", DepthPng(10'000));
    folder_.Write("depth/c.png", DepthPng(15'000));
  }
  void WriteObjects() {
    folder_.Write("mask.txt", kMasks);
    for (const char* name : {"mask/a.png", "mask/b.png", "mask/c.png"}) {
      folder_.Write(name, PngBytes(4, 3, {7, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 9}, {.bits = 8}));
    }
    folder_.Write("object_poses.txt", kObjects);
  }
  absl::StatusOr<LidarFolder> Open(const TumRgbdOptions& options = {}) {
    return OpenTumRgbd(folder_.path(), options);
  }
  // Of the sequence with that in one of its files, which is then as it was.
  std::string ErrorWith(const std::string& file, const std::string& bytes) {
    const std::string before = BytesOf(folder_ / file);
    folder_.Write(file, bytes);
    auto opened = Open();
    if (opened.ok()) opened = absl::StatusOr<LidarFolder>(opened->frames.read(0).status());
    folder_.Write(file, before);
    EXPECT_TRUE(absl::IsInvalidArgument(opened.status())) << opened.status();
    return std::string(opened.status().message());
  }

  TemporaryFolder folder_;
};

TEST_F(TumRgbd, IsToldByItsList) {
  EXPECT_TRUE(IsTumRgbd(folder_.path()));
  EXPECT_FALSE(IsTumRgbd(folder_ / "depth"));
  EXPECT_FALSE(IsTumRgbd("/nowhere"));
  EXPECT_TRUE(OpenTumRgbd(folder_ / "").ok());
  EXPECT_TRUE(OpenTumRgbd(folder_ / "depth/..").ok());
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

TEST_F(TumRgbd, FewerPixelsAndNearerOnes) {
  EXPECT_EQ(Open({.stride = 2})->frames.read(0)->points_S.size(), 1u);
  EXPECT_EQ(Open({.max_depth_m = 1.5})->frames.read(0)->points_S.size(), 2u);
  EXPECT_THAT(std::string(Open({.stride = 0}).status().message()), HasSubstr("stride: is 0"));
  EXPECT_THAT(std::string(Open({.max_depth_m = -1}).status().message()), HasSubstr("is -1"));
}

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
    std::filesystem::copy(folder_.path(),
                          folder_ / ".." / (folder_.path().filename().string() + name),
                          std::filesystem::copy_options::recursive);
    const std::filesystem::path copy = folder_.path().string() + name;
    const auto frame = OpenTumRgbd(copy)->frames.read(0);
    std::filesystem::remove_all(copy);
    ASSERT_TRUE(frame.ok()) << frame.status();
    EXPECT_NEAR(frame->points_S[1].x(), (2 - cx) / fx, 1e-6);
    EXPECT_NEAR(frame->points_S[1].y(), (1 - cy) / fy, 1e-6);
  }
}

TEST_F(TumRgbd, StampsAreExact) {
  folder_.Write("depth.txt", absl::StrReplaceAll(kDepth, {{".100000", ".100000001"}}));
  EXPECT_EQ(Open()->poses[0].stamp, At_ms(100) + Duration(1));
  folder_.Write("depth.txt", "1.3050311021e+09 depth/a.png\n");
  EXPECT_LE(std::chrono::abs(Open()->poses[0].stamp - At_ms(100)), Duration(200));
}

TEST_F(TumRgbd, SaysWhatIsMissing) {
  WriteObjects();
  for (const char* name : {"mask/b.png", "depth/b.png", "groundtruth.txt", "depth.txt"}) {
    std::filesystem::remove(folder_ / name);
    const absl::Status status = Open().status();
    EXPECT_TRUE(absl::IsNotFound(status)) << status;
    EXPECT_THAT(std::string(status.message()), HasSubstr(name));
    if (name == std::string("mask/b.png")) folder_.Write(name, BytesOf(folder_ / "mask/a.png"));
  }
}

TEST_F(TumRgbd, MayLackImages) {
  std::filesystem::remove(folder_ / "depth/b.png");
  const auto dut = Open({.allow_missing_points = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.read(1)->points_S.empty());
}

TEST_F(TumRgbd, SaysWhatIsWrongWhere) {
  WriteObjects();
  const std::string depth = kDepth, track = kTrack, objects = kObjects;
  EXPECT_THAT(ErrorWith("depth.txt", "# none\n"), HasSubstr("depth.txt: lists no image"));
  EXPECT_THAT(ErrorWith("depth.txt", depth + "1305031103 \n"), HasSubstr("line 7: 1 words"));
  EXPECT_THAT(ErrorWith("depth.txt", depth + "1305031102.166 depth/a.png\n"),
              HasSubstr("line 7: the stamp 1305031102166000000 ns does not come after"));
  EXPECT_THAT(ErrorWith("depth.txt", "noon depth/a.png\n"),
              HasSubstr("line 1, word 1: 'noon', expected seconds"));
  EXPECT_THAT(ErrorWith("depth.txt", "1e10 depth/a.png\n"), HasSubstr("word 1: '1e10'"));
  EXPECT_THAT(ErrorWith("depth.txt", "nan depth/a.png\n"), HasSubstr("word 1: 'nan'"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", ""), HasSubstr("groundtruth.txt: holds no pose"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031103 0 0 0 0 0 0\n"),
              HasSubstr("line 8: 7 words, expected timestamp tx ty tz qx qy qz qw"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031101 0 0 0 0 0 0 1\n"),
              HasSubstr("line 8: the stamp"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031103 0 x 0 0 0 0 1\n"),
              HasSubstr("line 8, word 3: 'x'"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track + "1305031103 0 0 0 0 0 0 0.9\n"),
              HasSubstr("line 8, words 5 to 8: no unit quaternion"));
  EXPECT_THAT(ErrorWith("groundtruth.txt", track.substr(0, track.size() - 1)),
              HasSubstr("seems cut off"));
  EXPECT_THAT(ErrorWith("object_poses.txt", objects + "1305031103 0 0 0 0 0 0 0 1\n"),
              HasSubstr("line 7, word 2: '0', expected an integer from 1"));
  EXPECT_THAT(ErrorWith("object_poses.txt", objects + "1305031102.1 7 0 0 0 0 0 0 1\n"),
              HasSubstr("line 7: the stamp"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 2 3\n"), HasSubstr("line 1: 3 words"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 0 3 4\n"),
              HasSubstr("word 2: '0', expected a number above"));
  EXPECT_THAT(ErrorWith("camera.txt", "1 1 3 4\n1 1 3 4\n"), HasSubstr("2 lines, expected one"));
  EXPECT_THAT(ErrorWith("depth/a.png", DepthPng(1).substr(0, 60)), HasSubstr("a.png: damaged"));
  EXPECT_THAT(ErrorWith("depth/a.png", PngBytes(1, 1, {1}, {.bits = 8})),
              HasSubstr("8 bits a pixel; depth images have 16"));
  EXPECT_THAT(ErrorWith("mask/a.png", PngBytes(3, 4, std::vector<int>(12, 0))),
              HasSubstr("mask/a.png: 3 x 4 pixels;"));
  EXPECT_THAT(ErrorWith("mask.txt", "1305031102.1 \n"), HasSubstr("mask.txt, line 1: 1 words"));
}

}  // namespace
}  // namespace clearway
