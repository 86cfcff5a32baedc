#include <gmock/gmock.h>

#include "io/recording_example.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

using ::testing::HasSubstr;

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
  EXPECT_EQ(nowhere.status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(nowhere.status().message()), HasSubstr("there is no folder /"));
  EXPECT_EQ(OpenRecording(folder / "a.cwr").status().code(), absl::StatusCode::kNotFound);
}

TEST(Recording, RefusesOtherKindsAndVersions) {
  TemporaryFolder folder;
  folder.Write("text", "these are no frames\n");
  EXPECT_EQ(OpenRecording(folder / "text").status().code(), absl::StatusCode::kInvalidArgument);
  folder.Write("cloud.pcd", "# .PCD v0.7\n");
  EXPECT_THAT(
      std::string(OpenRecording(folder / "cloud.pcd").status().message()),
      HasSubstr("cloud.pcd: not a recording; the file is a point cloud (PCD); give the folder "
                "that holds the clouds and the table of their poses"));
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

}  // namespace
}  // namespace clearway
