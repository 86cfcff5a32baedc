// Recorded tracks whose motions are missing now and then: objects are taken up where they are.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "clearway/io/lidar_folder.h"
#include "clearway/scene/scene_builder.h"
#include "support/data_folder.h"
#include "support/frames.h"

namespace clearway {
namespace {

// Points on the sides of the box that face the sensor, each at the end of a short ray of its own.
void Show(const RecordedBox& box, const Eigen::Vector3d& sensor_W, Frame& frame) {
  constexpr double kRay_m = 0.3;
  const Eigen::Vector3d sensor_B = Inverse(box.T_W_B) * sensor_W;
  const Pose T_S_W = Inverse(frame.T_W_S);
  for (const Eigen::Vector3d& p_B : testing_support::BoxSurface(box.size_m, 0.3)) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool on_side = std::abs(p_B[axis]) > box.size_m[axis] / 2 - 1e-6;
      if (!on_side || p_B[axis] * (sensor_B[axis] - p_B[axis]) <= 0) continue;
      const Eigen::Vector3d origin_B = p_B + kRay_m * (sensor_B - p_B).normalized();
      testing_support::AddPoint(frame, box.id, T_S_W * (box.T_W_B * p_B));
      frame.origins_S.push_back((T_S_W * (box.T_W_B * origin_B)).cast<float>());
      break;
    }
  }
}

struct Count {
  std::size_t sightings = 0, restarted = 0;
};

// Of each track, what is seen in a second: five frames with motions, one without, two with, then
// nothing for so many frames, and a sighting without a motion.
Count Resightings(const LidarFolder& folder, int gap_frames) {
  const int period = 9 + gap_frames;
  ThreadPool pool(1);
  SceneParams params;
  params.motion_from_points = MotionFromPoints::kOff;
  SceneBuilder builder(params, FrameLimits(), pool);
  Count count;
  std::map<ObjectId, int> seen;
  for (std::size_t k = 0; k < folder.frames.frame_count; ++k) {
    Frame frame = *folder.frames.read(k);
    std::vector<ObjectMotion> motions;
    for (const RecordedBox& box : folder.boxes) {
      if (box.frame != static_cast<int>(frame.sequence)) continue;
      const int phase = seen[box.id]++ % period;
      if (phase > 8) continue;  // not seen
      Show(box, frame.T_W_S.translation, frame);
      if (phase == 0 || phase == 5) continue;
      for (const ObjectMotion& motion : frame.motions) {
        if (motion.id == box.id) motions.push_back(motion);
      }
    }
    frame.motions = std::move(motions);
    const auto report = builder.Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    count.sightings += report->objects_bridged + report->objects_restarted;
    count.restarted += report->objects_restarted;
  }
  return count;
}

// None where there are no recordings.
std::vector<LidarFolder> Sequences() {
  std::vector<LidarFolder> sequences;
  const auto data = DataPath("kitti_tracks");
  if (!data) return sequences;
  for (const auto& sequence : std::filesystem::directory_iterator(*data)) {
    if (!sequence.is_directory()) continue;
    auto folder = OpenLidarFolder(sequence.path(), {.allow_missing_points = true});
    EXPECT_TRUE(folder.ok()) << folder.status();
    if (folder.ok()) sequences.push_back(*std::move(folder));
  }
  return sequences;
}

TEST(TrackGaps, FewerThanOneInAThousandSightingsBeginsAnew) {
  const std::vector<LidarFolder> sequences = Sequences();
  if (sequences.empty()) GTEST_SKIP() << "no recorded tracks";
  Count all;
  for (const LidarFolder& folder : sequences) {
    const Count count = Resightings(folder, 5);
    all.sightings += count.sightings;
    all.restarted += count.restarted;
  }
  std::printf("%zu of %zu sightings without a motion began anew\n", all.restarted, all.sightings);
  EXPECT_GT(all.sightings, 1'000u);
  EXPECT_LT(1'000 * all.restarted, all.sightings);
}

// Boxes that people drew jump a little; none should jump as if another thing had got its id.
TEST(TrackGaps, FewerThanOneInAThousandMotionsIsLeftOut) {
  const std::vector<LidarFolder> sequences = Sequences();
  if (sequences.empty()) GTEST_SKIP() << "no recorded tracks";
  std::size_t motions = 0, left_out = 0;
  for (const LidarFolder& folder : sequences) {
    ThreadPool pool(1);
    SceneBuilder builder(SceneParams{}, FrameLimits(), pool);
    for (std::size_t k = 0; k < folder.frames.frame_count; ++k) {
      Frame frame = *folder.frames.read(k);
      for (const RecordedBox& box : folder.boxes) {
        if (box.frame != static_cast<int>(frame.sequence)) continue;
        Show(box, frame.T_W_S.translation, frame);
      }
      const auto report = builder.Apply(frame);
      ASSERT_TRUE(report.ok()) << report.status();
      motions += frame.motions.size();
      left_out += report->motions_implausible;
    }
  }
  std::printf("%zu of %zu motions were left out\n", left_out, motions);
  EXPECT_GT(motions, 10'000u);
  EXPECT_LT(1'000 * left_out, motions);
}

}  // namespace
}  // namespace clearway
