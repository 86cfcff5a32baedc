#include "clearway/io/recording.h"

#include <gmock/gmock.h>

#include "clearway/io/lidar_folder.h"
#include "io/recording_example.h"
#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

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

TEST(Recording, KeepsTheRealDrive) {
  const auto path = DataPath("kitti0000_full");
  if (!path) GTEST_SKIP() << "no recorded data";
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
