// Worlds in UTM coordinates: moved, they are the same as the same data near the origin.
#include "clearway/io/world_origin.h"

#include <gmock/gmock.h>

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "clearway/io/recording.h"
#include "io/lidar_example.h"
#include "io/recording_example.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

const Eigen::Vector3d kUtm(500'000.25, 4'100'000.5, 312);

constexpr char kHeader[] = "frame,T00,T01,T02,T03,T10,T11,T12,T13,T20,T21,T22,T23\n";

// The matrix of a turn about z at a place.
std::string Row(const std::string& key, double yaw_rad, const Eigen::Vector3d& p) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return absl::StrFormat("%s,%.17g,%.17g,0,%.17g,%.17g,%.17g,0,%.17g,0,0,1,%.17g\n", key, c, -s,
                         p.x(), s, c, p.y(), p.z());
}

// A sensor that drives and a van that turns, all of it moved by `by`.
void WriteDrive(const TemporaryFolder& folder, const Eigen::Vector3d& by) {
  std::string poses = kHeader, boxes =
                                   "frame,track,type,l,w,h,n_points,T00,T01,T02,T03,T10,T11,T12,"
                                   "T13,T20,T21,T22,T23\n";
  for (int k = 0; k < 4; ++k) {
    poses += Row(absl::StrCat(k), 0.1 * k, by + Eigen::Vector3d(k, 0.5 * k, 1.5));
    boxes += Row(absl::StrCat(k, ",7,Van,4,2,2,1"), 0.3 * k, by + Eigen::Vector3d(9 + k, 3, 1));
    folder.Write(absl::StrFormat("points/%04d.bin", k), PointBytes({{1, 2, 3, 0}, {9, 3, 0, 7}}));
  }
  folder.Write("poses.csv", poses);
  folder.Write("objects.csv", boxes);
}

void ExpectNear(const Pose& a, const Pose& b) {
  EXPECT_LT((a.translation - b.translation).norm(), 1e-7);
  EXPECT_LT(a.rotation.angularDistance(b.rotation), 1e-9);
}

void ExpectSame(const FrameSource& dut, const FrameSource& expected) {
  ASSERT_EQ(dut.frame_count, expected.frame_count);
  for (std::size_t k = 0; k < expected.frame_count; ++k) {
    const auto a = dut.read(k), b = expected.read(k);
    ASSERT_TRUE(a.ok() && b.ok()) << a.status() << b.status();
    ExpectNear(a->T_W_S, b->T_W_S);
    EXPECT_EQ(a->points_S, b->points_S);
    ASSERT_EQ(a->motions.size(), b->motions.size());
    ASSERT_EQ(a->poses.size(), b->poses.size());
    for (std::size_t i = 0; i < a->motions.size(); ++i) {
      ExpectNear(a->motions[i].H_W, b->motions[i].H_W);
    }
    for (std::size_t i = 0; i < a->poses.size(); ++i) {
      ExpectNear(a->poses[i].T_W_B, b->poses[i].T_W_B);
    }
  }
}

absl::StatusOr<LidarFolder> Open(const TemporaryFolder& folder,
                                 const std::optional<WorldOrigin>& origin,
                                 LidarObjects objects = LidarObjects::kMotions) {
  auto opened = OpenLidarFolder(folder.path(), {.objects = objects});
  return opened.ok() ? WithOrigin(*std::move(opened), origin) : opened;
}

TEST(WorldOrigin, Empty) {
  const TemporaryFolder folder;
  WriteDrive(folder, Eigen::Vector3d::Zero());
  const auto dut = Open(folder, std::nullopt);
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_TRUE(dut->frames.origin_m.isZero(0));
  EXPECT_EQ(WithOrigin(FrameSource(), WorldOrigin{})->frame_count, 0u);
}

TEST(WorldOrigin, AMovedWorldIsTheSameAsOneNearTheOrigin) {
  const TemporaryFolder far, near;
  WriteDrive(far, kUtm);
  WriteDrive(near, Eigen::Vector3d::Zero());
  for (const LidarObjects objects : {LidarObjects::kMotions, LidarObjects::kPoses}) {
    const auto dut = Open(far, WorldOrigin{.position_m = kUtm}, objects);
    ASSERT_TRUE(dut.ok()) << dut.status();
    const auto expected = Open(near, std::nullopt, objects);
    EXPECT_EQ(dut->frames.origin_m, kUtm);
    ExpectSame(dut->frames, expected->frames);
    for (std::size_t i = 0; i < expected->boxes.size(); ++i) {
      ExpectNear(dut->boxes[i].T_W_B, expected->boxes[i].T_W_B);
    }
    for (std::size_t i = 0; i < expected->poses.size(); ++i) {
      ExpectNear(dut->poses[i].T_W_S, expected->poses[i].T_W_S);
    }
  }
}

TEST(WorldOrigin, FirstIsWhereTheSensorIsFirst) {
  const TemporaryFolder folder;
  WriteDrive(folder, kUtm);
  const auto dut = Open(folder, WorldOrigin{.at_first_pose = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames.origin_m, kUtm + Eigen::Vector3d(0, 0, 1.5));
  EXPECT_TRUE(dut->frames.read(0)->T_W_S.translation.isZero(0));
  EXPECT_EQ(dut->poses[2].T_W_S.translation, Eigen::Vector3d(2, 1, 0));
  EXPECT_THAT(dut->frames.description, HasSubstr("origin 500000.25,4100000.5,313.5 subtracted"));
}

TEST(WorldOrigin, AFarWorldIsRefusedWithTheLimitAndTheWayOut) {
  for (const Eigen::Vector3d& place : {kUtm, Eigen::Vector3d(0, 410'000, 0)}) {
    const TemporaryFolder folder;
    WriteDrive(folder, place);
    const auto dut = Open(folder, std::nullopt);
    EXPECT_EQ(dut.status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(dut.status().message(), HasSubstr("beyond the limit of 100000 m"));
    EXPECT_THAT(dut.status().message(), HasSubstr("--origin first"));
  }
}

TEST(WorldOrigin, WhereTheFirstPoseIsNoUseAnotherOriginIsAdvised) {
  const TemporaryFolder folder;
  WriteDrive(folder, Eigen::Vector3d::Zero());
  folder.Write("poses.csv", absl::StrCat(kHeader, Row("0", 0, {0, 0, 0}), Row("1", 0, kUtm),
                                         Row("2", 0, kUtm), Row("3", 0, kUtm)));
  const auto dut = Open(folder, WorldOrigin{.at_first_pose = true});
  EXPECT_THAT(dut.status().message(),
              HasSubstr("--origin x,y,z, near the poses, moves the origin"));
}

TEST(WorldOrigin, AnOriginFarFromThePosesIsRefused) {
  const TemporaryFolder folder;
  WriteDrive(folder, kUtm);
  const auto dut = Open(folder, WorldOrigin{.position_m = {500'000, 410'000, 0}});
  EXPECT_THAT(dut.status().message(), HasSubstr("origin 500000,410000,0 subtracted"));
  EXPECT_THAT(dut.status().message(),
              HasSubstr("the sensor is at 0.25,3690000.5,313.5 from there"));
}

TEST(WorldOrigin, SomeFarPosesAreLeftToTheScene) {
  const TemporaryFolder folder;
  WriteDrive(folder, Eigen::Vector3d::Zero());
  folder.Write("poses.csv", absl::StrCat(kHeader, Row("0", 0, {0, 0, 0}), Row("1", 0, {1, 0, 0}),
                                         Row("2", 0, {9e6, 0, 0}), Row("3", 0, {3, 0, 0})));
  EXPECT_TRUE(Open(folder, std::nullopt).ok());
}

// Frames 0 to 3, of which those before `readable` cannot be read.
FrameSource Damaged(std::size_t readable) {
  FrameSource source;
  source.frame_count = 4;
  source.read = [readable](std::size_t i) -> absl::StatusOr<Frame> {
    if (i < readable) return absl::DataLossError(absl::StrCat("frame ", i, ": damaged"));
    Frame frame = ExampleFrame(static_cast<int>(i));
    frame.T_W_S.translation = kUtm + Eigen::Vector3d(static_cast<double>(i), 0, 0);
    return frame;
  };
  return source;
}

TEST(WorldOrigin, IsSubtractedThoughTheFirstFrameCannotBeRead) {
  const auto fixed = WithOrigin(Damaged(1), WorldOrigin{.position_m = kUtm});
  ASSERT_TRUE(fixed.ok()) << fixed.status();
  EXPECT_EQ(fixed->origin_m, kUtm);
  EXPECT_EQ(fixed->read(2)->T_W_S.translation, Eigen::Vector3d(2, 0, 0));
  const auto first = WithOrigin(Damaged(1), WorldOrigin{.at_first_pose = true});
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_EQ(first->origin_m, kUtm + Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(first->read(2)->T_W_S.translation, Eigen::Vector3d(1, 0, 0));
  EXPECT_THAT(WithOrigin(Damaged(1), std::nullopt).status().message(),
              HasSubstr("beyond the limit of 100000 m"));
}

TEST(WorldOrigin, WhereNoFrameCanBeReadFirstIsAnError) {
  EXPECT_EQ(WithOrigin(Damaged(4), WorldOrigin{.at_first_pose = true}).status().message(),
            "frame 0: damaged");
  EXPECT_EQ(WithOrigin(Damaged(4), WorldOrigin{.position_m = kUtm})->origin_m, kUtm);
  EXPECT_TRUE(WithOrigin(Damaged(4), std::nullopt).ok());
}

TEST(WorldOrigin, IsKeptInARecording) {
  const TemporaryFolder folder;
  RecordingOptions options;
  options.origin_m = Eigen::Vector3d(1.0 / 3, -4'100'000.1, 1e-300);
  WriteFrames(folder / "utm.cwr", {ExampleFrame(0)}, options);
  const auto dut = OpenRecording(folder / "utm.cwr");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->origin_m, options.origin_m);
  EXPECT_TRUE(SameBits(*dut->read(0), ExampleFrame(0)));
  EXPECT_EQ(InspectRecording(folder / "utm.cwr")->origin_m, options.origin_m);
}

TEST(WorldOrigin, OfARecordingAddsUp) {
  const TemporaryFolder drive, folder;
  WriteDrive(drive, kUtm);
  const auto source = Open(drive, WorldOrigin{.position_m = kUtm});
  std::vector<Frame> frames;
  for (std::size_t k = 0; k < 4; ++k) frames.push_back(*source->frames.read(k));
  RecordingOptions options;
  options.origin_m = source->frames.origin_m;
  WriteFrames(folder / "utm.cwr", frames, options);
  const auto dut =
      WithOrigin(*OpenRecording(folder / "utm.cwr"), WorldOrigin{.at_first_pose = true});
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->origin_m, kUtm + Eigen::Vector3d(0, 0, 1.5));
  ExpectSame(*dut, Open(drive, WorldOrigin{.at_first_pose = true})->frames);
}

TEST(WorldOrigin, ARecordingWithoutOneHasNoTableForIt) {
  const TemporaryFolder folder;
  WriteFrames(folder / "a", {ExampleFrame(0)});
  auto database = SqliteDatabase::Open(folder / "a", SqliteDatabase::Mode::kReadOnly);
  EXPECT_EQ(*database->QueryInteger("SELECT COUNT(*) FROM sqlite_schema WHERE name = 'origin'"), 0);
}

TEST(WorldOrigin, ADamagedOneInARecordingIsRefused) {
  for (const char* change :
       {"UPDATE origin SET x_m = 7", "DELETE FROM origin", "ALTER TABLE origin RENAME TO origyn",
        "UPDATE origin SET checksum = checksum + 1"}) {
    const TemporaryFolder folder;
    RecordingOptions options;
    options.origin_m = kUtm;
    WriteFrames(folder / "a", {ExampleFrame(0)}, options);
    ChangeDatabase(folder / "a", change);
    EXPECT_EQ(OpenRecording(folder / "a").status().code(), absl::StatusCode::kDataLoss) << change;
  }
  RecordingOptions options;
  options.origin_m.x() = std::nan("");
  const TemporaryFolder folder;
  EXPECT_FALSE(RecordingWriter::Create(folder / "a", options).ok());
}

TEST(OriginText, KeepsEveryDigit) {
  EXPECT_EQ(OriginText({500'000, 4'100'000.1, -1.0 / 3}), "500000,4100000.1,-0.3333333333333333");
  EXPECT_EQ(OriginText(kUtm), "500000.25,4100000.5,312");
}

}  // namespace
}  // namespace clearway
