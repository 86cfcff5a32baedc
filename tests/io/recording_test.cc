#include "clearway/io/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "clearway/io/lidar_folder.h"
#include "io/sqlite.h"
#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

// Every field holds something, with numbers that decimal digits would lose.
Frame ExampleFrame(std::uint64_t sequence) {
  Frame frame;
  frame.sensor_id = "lidar front";
  frame.sequence = std::numeric_limits<std::uint64_t>::max() - sequence;
  frame.stamp = TimeFromNanoseconds(315973157959879000 + 100 * static_cast<int>(sequence));
  frame.T_W_S = {Eigen::Quaterniond(0.1, -0.2, 0.3, 1.0 / 3.0), {-0.0, 1e-300, 1.0 / 7.0}};
  for (int i = 0; i < 50; ++i) {
    frame.points_S.emplace_back(0.1f * i, -1.0f / 3.0f, std::numeric_limits<float>::quiet_NaN());
    frame.labels.push_back(i % 5 - 1);
    frame.no_return.push_back(i % 2);
    frame.origins_S.emplace_back(0.0f, 1e-42f * i, -0.0f);
  }
  frame.motions.push_back({3, Pose::Translation(1.0 / 3.0, 2, 3), frame.stamp - Duration(7)});
  frame.poses.push_back({1, Pose::Translation(5e300, -1.0 / 9.0, 0)});
  return frame;
}

template <class T>
bool SameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool SameBits(const Pose& a, const Pose& b) {
  return std::memcmp(a.rotation.coeffs().data(), b.rotation.coeffs().data(), 32) == 0 &&
         std::memcmp(a.translation.data(), b.translation.data(), 24) == 0;
}

bool SameBits(const Frame& a, const Frame& b) {
  const auto same_motion = [](const ObjectMotion& x, const ObjectMotion& y) {
    return x.id == y.id && x.from == y.from && SameBits(x.H_W, y.H_W);
  };
  const auto same_pose = [](const ObjectPose& x, const ObjectPose& y) {
    return x.id == y.id && SameBits(x.T_W_B, y.T_W_B);
  };
  return a.sensor_id == b.sensor_id && a.sequence == b.sequence && a.stamp == b.stamp &&
         SameBits(a.T_W_S, b.T_W_S) && SameBits(a.points_S, b.points_S) && a.labels == b.labels &&
         a.no_return == b.no_return && SameBits(a.origins_S, b.origins_S) &&
         std::equal(a.motions.begin(), a.motions.end(), b.motions.begin(), b.motions.end(),
                    same_motion) &&
         std::equal(a.poses.begin(), a.poses.end(), b.poses.begin(), b.poses.end(), same_pose);
}

void WriteFrames(const std::filesystem::path& path, const std::vector<Frame>& frames,
                 const RecordingOptions& options = {}) {
  auto dut = RecordingWriter::Create(path, options);
  ASSERT_TRUE(dut.ok()) << dut.status();
  for (const Frame& frame : frames) ASSERT_TRUE((*dut)->Append(frame).ok());
  ASSERT_TRUE((*dut)->Close().ok());
}

void ChangeDatabase(const std::filesystem::path& path, const std::string& sql) {
  auto database = SqliteDatabase::Open(path, SqliteDatabase::Mode::kCreate);
  ASSERT_TRUE(database.ok()) << database.status();
  ASSERT_TRUE(database->Execute(sql).ok()) << database->Execute(sql);
}

TEST(Recording, Empty) {
  TemporaryFolder folder;
  RecordingOptions options;
  options.description = "nothing at all";
  options.resolution_m = 0.05;
  WriteFrames(folder / "a.cwr", {}, options);
  const auto dut = OpenRecording(folder / "a.cwr");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frame_count, 0u);
  EXPECT_EQ(dut->resolution_m, 0.05);
  EXPECT_THAT(dut->description, HasSubstr("nothing at all"));
  EXPECT_EQ(InspectRecording(folder / "a.cwr")->frames, 0);
  EXPECT_EQ(dut->read(0).status().code(), absl::StatusCode::kOutOfRange);
}

TEST(Recording, FramesComeBackBitForBit) {
  TemporaryFolder folder;
  std::vector<Frame> frames;
  for (int i = 0; i < 70; ++i) frames.push_back(ExampleFrame(i));  // more than two transactions
  frames[1] = Frame();
  frames[2].no_return.clear();
  frames[3].origins_S.clear();
  WriteFrames(folder / "a.cwr", frames);
  const auto dut = OpenRecording(folder / "a.cwr");
  ASSERT_TRUE(dut.ok()) << dut.status();
  ASSERT_EQ(dut->frame_count, frames.size());
  for (std::size_t i : {69, 0, 1, 2, 3, 31, 32, 33, 0}) {  // in any order, and again
    const auto frame = dut->read(i);
    ASSERT_TRUE(frame.ok()) << frame.status();
    EXPECT_TRUE(SameBits(*frame, frames[i])) << i;
  }
}

TEST(Recording, SameFramesMakeTheSameFile) {
  TemporaryFolder folder;
  WriteFrames(folder / "a.cwr", {ExampleFrame(0), ExampleFrame(1)});
  WriteFrames(folder / "b.cwr", {ExampleFrame(0), ExampleFrame(1)});
  EXPECT_EQ(BytesOf(folder / "a.cwr"), BytesOf(folder / "b.cwr"));
}

TEST(Recording, Lists) {
  TemporaryFolder folder;
  WriteFrames(folder / "a.cwr", {ExampleFrame(0), ExampleFrame(3)});
  const auto dut = InspectRecording(folder / "a.cwr");
  ASSERT_TRUE(dut.ok()) << dut.status();
  EXPECT_EQ(dut->frames, 2);
  EXPECT_EQ(dut->points, 100);
  EXPECT_EQ(dut->duration(), Duration(300));
  EXPECT_EQ(dut->sensors, (std::map<std::string, std::int64_t>{{"lidar front", 2}}));
  ASSERT_EQ(dut->objects.size(), 3u);  // 0 is static, -1 left out
  EXPECT_EQ(dut->objects.at(3).points, 20);
  EXPECT_EQ(dut->objects.at(3).frames, 2);
  EXPECT_EQ(dut->objects.at(3).motions, 2);
  EXPECT_EQ(dut->objects.at(2).motions, 0);
  EXPECT_EQ(dut->file_bytes, std::filesystem::file_size(folder / "a.cwr"));
}

TEST(Recording, IsWholeOrNotThere) {
  TemporaryFolder folder;
  {
    auto dut = RecordingWriter::Create(folder / "a.cwr");
    ASSERT_TRUE((*dut)->Append(ExampleFrame(0)).ok());
    EXPECT_FALSE(std::filesystem::exists(folder / "a.cwr"));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Recording, ReplacesAFileOnlyIfAsked) {
  TemporaryFolder folder;
  WriteFrames(folder / "a.cwr", {ExampleFrame(0)});
  EXPECT_EQ(RecordingWriter::Create(folder / "a.cwr").status().code(),
            absl::StatusCode::kAlreadyExists);
  RecordingOptions options;
  options.overwrite = true;
  WriteFrames(folder / "a.cwr", {}, options);
  EXPECT_EQ(OpenRecording(folder / "a.cwr")->frame_count, 0u);
}

TEST(Recording, RefusesFramesWhoseArraysDisagreeAndGoesOn) {
  TemporaryFolder folder;
  auto dut = RecordingWriter::Create(folder / "a.cwr");
  Frame frame = ExampleFrame(0);
  frame.labels.pop_back();
  EXPECT_THAT(std::string((*dut)->Append(frame).message()),
              HasSubstr("labels holds 49 values for 50 points"));
  frame = ExampleFrame(0);
  frame.no_return.push_back(1);
  EXPECT_EQ((*dut)->Append(frame).code(), absl::StatusCode::kInvalidArgument);
  frame = ExampleFrame(0);
  frame.origins_S.pop_back();
  EXPECT_EQ((*dut)->Append(frame).code(), absl::StatusCode::kInvalidArgument);
  EXPECT_TRUE((*dut)->Append(ExampleFrame(0)).ok());
  EXPECT_TRUE((*dut)->Close().ok());
  EXPECT_EQ((*dut)->Append(ExampleFrame(1)).code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(OpenRecording(folder / "a.cwr")->frame_count, 1u);
}

TEST(Recording, RefusesBadOptionsAndPlaces) {
  TemporaryFolder folder;
  RecordingOptions options;
  options.resolution_m = 0;
  EXPECT_EQ(RecordingWriter::Create(folder / "a.cwr", options).status().code(),
            absl::StatusCode::kInvalidArgument);
  options = {};
  options.compression_level = 0;
  EXPECT_EQ(RecordingWriter::Create(folder / "a.cwr", options).status().code(),
            absl::StatusCode::kInvalidArgument);
  const auto nowhere = RecordingWriter::Create(folder / "no/such/folder/a.cwr");
  EXPECT_EQ(nowhere.status().code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(OpenRecording(folder / "a.cwr").status().code(), absl::StatusCode::kNotFound);
}

TEST(Recording, RefusesOtherKindsAndVersions) {
  TemporaryFolder folder;
  folder.Write("text", "these are no frames\n");
  EXPECT_EQ(OpenRecording(folder / "text").status().code(), absl::StatusCode::kInvalidArgument);
  ChangeDatabase(folder / "other", "CREATE TABLE t (x)");
  EXPECT_EQ(OpenRecording(folder / "other").status().code(), absl::StatusCode::kInvalidArgument);
  WriteFrames(folder / "new", {ExampleFrame(0)});
  ChangeDatabase(folder / "new", "PRAGMA user_version = 2");
  const auto dut = OpenRecording(folder / "new");
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(dut.status().message()),
              HasSubstr("version 2; this program reads version 1"));
}

TEST(Recording, RefusesMissingFramesAndTables) {
  TemporaryFolder folder;
  WriteFrames(folder / "a", {ExampleFrame(0), ExampleFrame(1)});
  ChangeDatabase(folder / "a", "DELETE FROM frame WHERE number = 1");
  EXPECT_THAT(std::string(OpenRecording(folder / "a").status().message()),
              HasSubstr("1 frames are there instead of 2"));
  WriteFrames(folder / "b", {ExampleFrame(0), ExampleFrame(1)});
  ChangeDatabase(folder / "b", "UPDATE frame SET number = 5 WHERE number = 1");
  EXPECT_EQ(OpenRecording(folder / "b")->read(1).status().code(), absl::StatusCode::kDataLoss);
  WriteFrames(folder / "c", {});
  ChangeDatabase(folder / "c", "DROP TABLE frame");
  EXPECT_EQ(OpenRecording(folder / "c").status().code(), absl::StatusCode::kDataLoss);
  WriteFrames(folder / "d", {});
  ChangeDatabase(folder / "d", "UPDATE meta SET resolution_m = 7.0");
  EXPECT_THAT(std::string(OpenRecording(folder / "d").status().message()), HasSubstr("meta"));
}

TEST(Recording, RefusesChangedColumns) {
  TemporaryFolder folder;
  for (const std::string change :
       {"sensor_id = 'x'", "sequence = 0", "stamp_ns = stamp_ns + 1", "point_count = 49",
        "arrays = 0", "world_from_sensor = zeroblob(56)", "motions = x''", "poses = zeroblob(60)",
        "points = x'00'", "checksum = checksum + 1"}) {
    WriteFrames(folder / change, {ExampleFrame(0)});
    ChangeDatabase(folder / change, "UPDATE frame SET " + change);
    const auto frame = OpenRecording(folder / change)->read(0);
    EXPECT_EQ(frame.status().code(), absl::StatusCode::kDataLoss) << change;
    EXPECT_THAT(std::string(frame.status().message()), HasSubstr(", frame 0: damaged")) << change;
  }
}

TEST(Recording, RefusesFilesCutOffAnywhere) {
  TemporaryFolder folder;
  WriteFrames(folder / "whole", {ExampleFrame(0), ExampleFrame(1)});
  const std::string whole = BytesOf(folder / "whole");
  folder.Write("cut", whole);
  for (std::size_t size = whole.size(); size-- > 0; size -= size < 110 ? 0 : 37) {
    std::filesystem::resize_file(folder / "cut", size);
    EXPECT_FALSE(OpenRecording(folder / "cut").ok()) << size;
  }
  folder.Write("cut", whole.substr(0, whole.size() - 1));
  EXPECT_EQ(OpenRecording(folder / "cut").status().code(), absl::StatusCode::kDataLoss);
  folder.Write("cut", whole + '\0');
  EXPECT_EQ(OpenRecording(folder / "cut").status().code(), absl::StatusCode::kDataLoss);
}

TEST(Recording, ADamagedByteIsAnErrorOrChangesNothing) {
  TemporaryFolder folder;
  const std::vector<Frame> frames = {ExampleFrame(0), ExampleFrame(1)};
  WriteFrames(folder / "whole", frames);
  const std::string whole = BytesOf(folder / "whole");
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); at += at < 100 ? 1 : 29) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(~damaged[at]);
    folder.Write("damaged", damaged);
    const auto dut = OpenRecording(folder / "damaged");
    if (!dut.ok()) {
      ++refused;
      continue;
    }
    ASSERT_EQ(dut->frame_count, frames.size()) << at;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto frame = dut->read(i);
      EXPECT_TRUE(!frame.ok() || SameBits(*frame, frames[i])) << at;
      refused += frame.ok() ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(Recording, KeepsTheRealDrive) {
  const auto path = DataPath("kitti0000_full");
  if (!path) return;
  LidarFolderOptions options;
  options.last_frame = 2;
  const auto lidar = OpenLidarFolder(*path, options);
  ASSERT_TRUE(lidar.ok()) << lidar.status();
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < 3; ++i) frames.push_back(*lidar->frames.read(i));
  TemporaryFolder folder;
  WriteFrames(folder / "a.cwr", frames);
  const auto dut = OpenRecording(folder / "a.cwr");
  ASSERT_TRUE(dut.ok()) << dut.status();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(SameBits(*dut->read(i), frames[i]));
  const std::uint64_t raw = 16 * 3 * frames[0].points_S.size();
  EXPECT_LT(InspectRecording(folder / "a.cwr")->file_bytes, raw * 6 / 10);
}

}  // namespace
}  // namespace clearway
