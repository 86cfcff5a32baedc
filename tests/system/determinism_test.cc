// The same frames make the same scene, whatever the number of threads, also through a recording.
#include <gtest/gtest.h>

#include <set>

#include "clearway/io/lidar_folder.h"
#include "clearway/io/recording.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "support/data_folder.h"
#include "support/temporary_folder.h"

namespace clearway {
namespace {

std::string HashOf(const FrameSource& source, int threads, const SceneParams& params = {}) {
  ThreadPool pool(threads);
  SceneBuilder builder(params, {}, pool);
  for (std::size_t k = 0; k < source.frame_count; ++k) {
    const auto frame = source.read(k);
    EXPECT_TRUE(frame.ok()) << frame.status();
    EXPECT_TRUE(builder.Apply(*frame).ok());
  }
  return builder.Publish()->Hash();
}

// The recorded frames if they are there, else simulated ones.
FrameSource SomeFrames() {
  if (const auto data = DataFolder()) {
    LidarFolderOptions options;
    options.last_frame = 7;
    return OpenLidarFolder(*data / "kitti0000_fov", options)->frames;
  }
  ScenarioOptions options;
  options.frame_count = 8;
  options.beams = 32;
  return MakeScenario("crossing", options)->Frames();
}

TEST(Determinism, ReplayingARecordingTwiceWithOneAndTwoThreads) {
  const FrameSource frames = SomeFrames();
  const TemporaryFolder folder;
  const auto path = folder.path() / "drive.clearway";
  auto writer = RecordingWriter::Create(path);
  ASSERT_TRUE(writer.ok()) << writer.status();
  for (std::size_t k = 0; k < frames.frame_count; ++k)
    ASSERT_TRUE((*writer)->Append(*frames.read(k)).ok());
  ASSERT_TRUE((*writer)->Close().ok());
  const auto recording = OpenRecording(path);
  ASSERT_TRUE(recording.ok()) << recording.status();
  std::set<std::string> hashes{HashOf(frames, 1)};
  for (int threads : {1, 1, 2, 2}) hashes.insert(HashOf(*recording, threads));
  EXPECT_EQ(hashes.size(), 1u);
}

// Whole scans if they are there, else simulated ones.
FrameSource WholeScans() {
  if (const auto folder = DataPath("kitti0000_full")) {
    LidarFolderOptions options;
    options.last_frame = 2;
    return OpenLidarFolder(*folder, options)->frames;
  }
  ScenarioOptions options;
  options.frame_count = 3;
  return MakeScenario("street", options)->Frames();
}

TEST(Determinism, WholeScansWithSeveralThreads) {
  const FrameSource frames = WholeScans();
  SceneParams params;
  params.rays.max_range_m = 50;
  const std::string expected = HashOf(frames, 1, params);
  for (int threads : {2, 3, 8}) EXPECT_EQ(HashOf(frames, threads, params), expected) << threads;
}

}  // namespace
}  // namespace clearway
