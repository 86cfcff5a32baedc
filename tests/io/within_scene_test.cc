#include "clearway/io/within_scene.h"

#include <gmock/gmock.h>

#include <array>
#include <optional>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/io/world_origin.h"
#include "clearway/scene/scene_builder.h"
#include "io/lidar_example.h"

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// What is strange of a drive of six frames with a van.
struct Strange {
  int pose_frame = -1;
  double pose_x_m = 0;
  int box_frame = -1;
  double box_x_m = 0;
  std::array<std::int64_t, 6> stamps_s = {100, 101, 102, 103, 104, 105};
};

LidarFolder Opened(const Strange& strange,
                   const LidarFolderOptions& options = {.objects = LidarObjects::kPoses},
                   const std::optional<WorldOrigin>& origin = std::nullopt) {
  const TemporaryFolder folder;
  std::string poses = "frame,timestamp_ns,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";
  std::string boxes =
      "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";
  for (int k = 0; k < 6; ++k) {
    const double x_m = k == strange.pose_frame ? strange.pose_x_m : k;
    const double box_x_m = k == strange.box_frame ? strange.box_x_m : 9 + k;
    poses += absl::StrFormat("%d,%d,1,0,0,%.17g,0,1,0,0,0,0,1,1\n", k,
                             strange.stamps_s[static_cast<std::size_t>(k)] * kSecond_ns, x_m);
    boxes += absl::StrFormat("%d,7,Van,4,2,2,1,1,0,0,%.17g,0,1,0,0,0,0,1,1\n", k, box_x_m);
    folder.Write(absl::StrFormat("points/%04d.bin", k), PointBytes({{9, 0, 0, 7}}));
  }
  folder.Write("poses.csv", poses);
  folder.Write("objects.csv", boxes);
  auto opened = OpenLidarFolder(folder.path(), options);
  EXPECT_TRUE(opened.ok()) << opened.status();
  opened = WithOrigin(*std::move(opened), origin);
  EXPECT_TRUE(opened.ok()) << opened.status();
  auto dut = WithinScene(*std::move(opened));
  EXPECT_TRUE(dut.ok()) << dut.status();
  // The files go: all is read before.
  std::vector<Frame> frames;
  for (std::size_t k = 0; k < dut->frames.frame_count; ++k) {
    const auto frame = dut->frames.read(k);
    EXPECT_TRUE(frame.ok()) << frame.status();
    frames.push_back(*frame);
  }
  dut->frames.read = [frames](std::size_t k) -> absl::StatusOr<Frame> { return frames[k]; };
  return *dut;
}

std::vector<int> NumbersOf(const LidarFolder& folder) {
  std::vector<int> numbers;
  for (std::size_t k = 0; k < folder.frames.frame_count; ++k) {
    numbers.push_back(static_cast<int>(folder.frames.read(k)->sequence));
  }
  return numbers;
}

// The only motion of a frame starts at that second and goes so far along x.
void ExpectMotion(const LidarFolder& folder, std::size_t index, std::int64_t from_s, double x_m) {
  const Frame frame = *folder.frames.read(index);
  ASSERT_EQ(frame.motions.size(), 1u) << index;
  EXPECT_EQ(ToNanoseconds(frame.motions[0].from), from_s * kSecond_ns) << index;
  EXPECT_TRUE(frame.motions[0].H_W.translation.isApprox(Eigen::Vector3d(x_m, 0, 0))) << index;
}

void ExpectApplied(const LidarFolder& folder) {
  ThreadPool pool(1);
  SceneBuilder scene(SceneParams{}, FrameLimits{}, pool);
  for (std::size_t k = 0; k < folder.frames.frame_count; ++k) {
    const auto report = scene.Apply(*folder.frames.read(k));
    EXPECT_TRUE(report.ok()) << report.status();
  }
}

TEST(WithinScene, NothingStrangeIsLeftOut) {
  const LidarFolder dut = Opened({});
  EXPECT_THAT(NumbersOf(dut), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_TRUE(dut.frames.left_out->Empty());
  ExpectApplied(dut);
}

TEST(WithinScene, AFarPoseIsLeftOutAndNamed) {
  const LidarFolder dut = Opened({.pose_frame = 2, .pose_x_m = 3e6});
  EXPECT_THAT(NumbersOf(dut), ElementsAre(0, 1, 3, 4, 5));
  EXPECT_EQ(dut.poses.size(), 5u);
  EXPECT_EQ(dut.frames.left_out->frames, 1u);
  EXPECT_THAT(dut.frames.left_out->reasons,
              ElementsAre("frame 2: the sensor is at 3000000,0,1, beyond the limit of 100000 m"));
  ExpectApplied(dut);
}

TEST(WithinScene, SoIsAFarBox) {
  const LidarFolder dut = Opened({.box_frame = 3, .box_x_m = -2e5});
  EXPECT_THAT(NumbersOf(dut), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_TRUE(dut.frames.read(3)->poses.empty());
  EXPECT_EQ(dut.frames.read(4)->poses.size(), 1u);
  EXPECT_EQ(dut.boxes.size(), 5u);
  EXPECT_EQ(dut.frames.left_out->rows, 1u);
  EXPECT_THAT(dut.frames.left_out->reasons,
              ElementsAre("frame 3, object 7: the box is at -200000,0,1, beyond the limit of "
                          "100000 m"));
  ExpectApplied(dut);
}

TEST(WithinScene, MotionsStartAtTheLastFrameThatCounts) {
  for (const std::optional<WorldOrigin>& origin :
       {std::optional<WorldOrigin>(), std::optional(WorldOrigin{.position_m = {-50, 8, 2}})}) {
    const LidarFolder dut = Opened({.pose_frame = 2, .pose_x_m = 3e6}, {}, origin);
    EXPECT_THAT(NumbersOf(dut), ElementsAre(0, 1, 3, 4, 5));
    ExpectMotion(dut, 1, 100, 1);
    ExpectMotion(dut, 2, 101, 2);  // over the frame that is left out
    ExpectMotion(dut, 3, 103, 1);
    ExpectApplied(dut);
  }
}

TEST(WithinScene, NoMotionLeadsToOrFromAFarBox) {
  const LidarFolder dut = Opened({.box_frame = 3, .box_x_m = -2e5}, {});
  ExpectMotion(dut, 2, 101, 1);
  EXPECT_TRUE(dut.frames.read(3)->motions.empty());
  ExpectMotion(dut, 4, 102, 2);
  ExpectMotion(dut, 5, 104, 1);
  ExpectApplied(dut);
}

TEST(WithinScene, BoxesOfFramesThatAreLeftOutDoNotCount) {
  const LidarFolder dut =
      Opened({.pose_frame = 2, .pose_x_m = 3e6, .box_frame = 2, .box_x_m = 2e5});
  EXPECT_EQ(dut.boxes.size(), 5u);
  EXPECT_EQ(dut.frames.left_out->frames, 1u);
  EXPECT_EQ(dut.frames.left_out->rows, 0u);
}

TEST(WithinScene, AStampAloneAtEitherEndIsLeftOut) {
  const LidarFolder first = Opened(
      {.stamps_s = {0, 1'700'000'000, 1'700'000'001, 1'700'000'002, 1'700'000'003, 1'700'000'004}});
  EXPECT_THAT(NumbersOf(first), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(
      first.frames.left_out->reasons,
      ElementsAre("frame 0: the stamp 0 ns lies 1700000000 s from that of the frame next to "
                  "it; the limit is 3600 s"));
  ExpectApplied(first);
  const LidarFolder last = Opened({.stamps_s = {0, 1, 2, 3, 4, 4'000'000'000}});
  EXPECT_THAT(NumbersOf(last), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(last.frames.left_out->frames, 1u);
  ExpectApplied(last);
}

// Nothing would have a velocity.
TEST(WithinScene, StampsOfAnotherUnitAreRefused) {
  LidarFolder folder;
  for (int k = 0; k < 6; ++k) {
    folder.poses.push_back({k, TimeFromNanoseconds(100'000 * k), Pose()});
  }
  const auto dut = WithinScene(std::move(folder));
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(dut.status().message()),
              HasSubstr("most of the 6 frames' stamps are 100000 ns apart or less"));
}

TEST(WithinScene, AStampThatNoSceneTakesIsLeftOut) {
  const LidarFolder dut = Opened({.stamps_s = {0, 1, 2, 3, 4, 9'000'000'000}});
  EXPECT_THAT(NumbersOf(dut), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(dut.frames.left_out->reasons, ElementsAre(HasSubstr("beyond the limit of 2^62 ns")));
}

TEST(WithinScene, AGapIsNoStrayStamp) {
  for (const std::array<std::int64_t, 6>& stamps_s :
       {std::array<std::int64_t, 6>{0, 1, 90'000, 90'001, 90'002, 90'003},
        {0, 90'000, 180'000, 270'000, 360'000, 450'000}}) {
    const LidarFolder dut = Opened({.stamps_s = stamps_s});
    EXPECT_EQ(dut.frames.frame_count, 6u);
    EXPECT_TRUE(dut.frames.left_out->Empty());
  }
}

TEST(WithinScene, FramesOfARange) {
  LidarFolderOptions options;
  options.first_frame = 1;
  options.last_frame = 4;
  const LidarFolder dut = Opened({.pose_frame = 2, .pose_x_m = 3e6}, options);
  ExpectMotion(dut, 1, 101, 2);
  EXPECT_THAT(NumbersOf(dut), ElementsAre(1, 3, 4));
  EXPECT_EQ(dut.poses[dut.first_pose].frame, 1);
}

TEST(WithinScene, ARangeOfFarFramesAloneIsRefused) {
  const TemporaryFolder folder;
  WriteExample(folder);
  LidarFolderOptions options;
  options.first_frame = 6;
  auto opened = OpenLidarFolder(folder.path(), options);
  ASSERT_TRUE(opened.ok()) << opened.status();
  opened->poses.back().T_W_S.translation.x() = 1e6;
  EXPECT_THAT(std::string(WithinScene(*opened).status().message()),
              HasSubstr("no frame can be used; frame 6: the sensor is at 1000000,0,1.5"));
}

TEST(WithinScene, WithoutAnyFrameTheFolderIsRefused) {
  LidarFolder folder;
  folder.frames.description = "a drive";
  folder.poses = {{0, TimeFromNanoseconds(kFarthest_ns + 1), Pose()}};
  folder.frames.frame_count = 1;
  const absl::Status status = WithinScene(folder).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status));
  EXPECT_THAT(std::string(status.message()), HasSubstr("a drive: no frame can be used; frame 0"));
}

}  // namespace
}  // namespace clearway
