// On real scans our static map holds the voxels of OctoMap's, in both ray modes.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cstdlib>
#include <iostream>

#include "clearway/io/lidar_folder.h"
#include "clearway/io/point_cloud_file.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "support/bzip2.h"
#include "support/data_folder.h"
#include "support/octomap_oracle.h"

namespace clearway {
namespace {

// With CLEARWAY_ALL_FRAMES set every frame is compared, which takes minutes; else some.
std::vector<std::size_t> FramesOf(const FrameSource& source, std::size_t step) {
  std::vector<std::size_t> frames;
  if (std::getenv("CLEARWAY_ALL_FRAMES") != nullptr) step = 1;
  for (std::size_t k = 0; k < source.frame_count; k += step) frames.push_back(k);
  return frames;
}

// OctoMap's update by one frame: the rays of all points but those of label -1 and lost returns (0,
// 0, 0), the end voxels of objects taken out.
class OctomapStaticMap {
 public:
  OctomapStaticMap(double resolution_m, const RayOptions& rays)
      : tree_(resolution_m), rays_(rays) {}

  void Insert(const Frame& frame) {
    octomap::Pointcloud all, fixed;
    for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
      const bool is_lost = frame.points_S[i].isZero(0);
      if (frame.labels[i] == kIgnoreLabel || is_lost) continue;
      const Eigen::Vector3f p_W = (frame.T_W_S * frame.points_S[i].cast<double>()).cast<float>();
      all.push_back(testing_support::ToOctomap(p_W));
      if (frame.labels[i] == kStaticLabel) fixed.push_back(testing_support::ToOctomap(p_W));
    }
    const auto origin = testing_support::ToOctomap(frame.T_W_S.translation.cast<float>());
    octomap::KeySet free, ends, static_free, static_ends;
    Compute(all, origin, free, ends);
    Compute(fixed, origin, static_free, static_ends);
    for (const auto& key : free) tree_.updateNode(key, false, true);
    for (const auto& key : static_ends) tree_.updateNode(key, true, true);
    objects_only_ += static_cast<std::int64_t>(ends.size() - static_ends.size());
  }
  octomap::OcTree& tree() {
    tree_.updateInnerOccupancy();
    return tree_;
  }
  std::int64_t objects_only() const { return objects_only_; }

 private:
  void Compute(const octomap::Pointcloud& cloud, const octomap::point3d& origin,
               octomap::KeySet& free, octomap::KeySet& ends) {
    if (rays_.discretize) {
      tree_.computeDiscreteUpdate(cloud, origin, free, ends, rays_.max_range_m);
    } else {
      tree_.computeUpdate(cloud, origin, free, ends, rays_.max_range_m);
    }
  }
  octomap::OcTree tree_;
  RayOptions rays_;
  std::int64_t objects_only_ = 0;
};

struct Case {
  const char* folder;
  std::size_t step;
  RayOptions rays;
};
// Applies the frames to ours and OctoMap's, and compares; at least so many end voxels must be of
// objects alone.
void ExpectSameStaticMap(const std::vector<Frame>& frames, double resolution_m,
                         const RayOptions& rays, std::int64_t least_of_objects = 0) {
  SceneParams params;
  params.resolution_m = resolution_m;
  params.rays = rays;
  params.rays.octomap_ends = true;
  ThreadPool pool(2);
  SceneBuilder dut(params, {}, pool);
  OctomapStaticMap oracle(resolution_m, rays);
  for (const Frame& frame : frames) {
    ASSERT_TRUE(dut.Apply(frame).ok());
    oracle.Insert(frame);
  }
  const auto comparison = testing_support::Compare(dut.Publish()->static_map_W, oracle.tree());
  std::cout << comparison.voxels << " voxels, " << comparison.state_differences
            << " states differ, log-odds differ by at most " << comparison.largest_log_odds_error
            << "; " << oracle.objects_only() << " end voxels of objects alone\n";
  EXPECT_GT(comparison.voxels, 50'000);
  EXPECT_EQ(comparison.state_differences, 0);
  EXPECT_LT(comparison.largest_log_odds_error, 0.01);
  EXPECT_GE(oracle.objects_only(), least_of_objects);
}

// The drive if it is there, else one of the simulator.
absl::StatusOr<FrameSource> RecordedOrSimulated(const char* folder) {
  if (const auto path = DataPath(folder)) {
    auto drive = OpenLidarFolder(*path);
    if (!drive.ok()) return drive.status();
    return drive->frames;
  }
  ScenarioOptions options;
  options.frame_count = 41;
  options.beams = 32;
  return MakeScenario("crossing", options)->Frames();
}

class OctomapRecordingsTest : public testing::TestWithParam<Case> {};

TEST_P(OctomapRecordingsTest, SameStaticMap) {
  const auto source = RecordedOrSimulated(GetParam().folder);
  ASSERT_TRUE(source.ok()) << source.status();
  std::vector<Frame> frames;
  for (std::size_t k : FramesOf(*source, GetParam().step)) {
    const auto frame = source->read(k);
    ASSERT_TRUE(frame.ok()) << frame.status();
    frames.push_back(*frame);
  }
  ExpectSameStaticMap(frames, 0.1, GetParam().rays);
}

INSTANTIATE_TEST_SUITE_P(Drives, OctomapRecordingsTest,
                         testing::Values(Case{"kitti0000_full", 10, {50.0, false}},
                                         Case{"kitti0000_full", 20, {50.0, true}},
                                         Case{"kitti0000_fov", 25, {50.0, false}},
                                         Case{"kitti0000_fov", 25, {50.0, true}},
                                         Case{"kitti0000_fov", 40, {-1, false}},
                                         Case{"kitti0000_fov", 40, {-1, true}}),
                         [](const auto& drive) { return "Drive" + std::to_string(drive.index); });

// Depth images: rays much closer together than voxels, of any length, from a camera beside objects.
TEST(OctomapDepthTest, SameStaticMap) {
  const auto lab = MakeScenario("lab", {.image_width_px = 640});
  ASSERT_TRUE(lab.ok()) << lab.status();
  ExpectSameStaticMap({lab->MakeFrame(0), lab->MakeFrame(5)}, 0.05, {-1, false}, 1'000);
}

class OctomapScansTest : public testing::TestWithParam<bool> {
 protected:
  // Each cloud as a frame of static points.
  static std::vector<Frame> Frames(const std::vector<PosedCloud>& clouds) {
    std::vector<Frame> frames;
    for (const PosedCloud& cloud : clouds) {
      Frame frame;
      frame.stamp = TimeFromNanoseconds(static_cast<std::int64_t>(frames.size()));
      frame.T_W_S = cloud.T_W_S;
      frame.points_S = cloud.points_S;
      frame.labels.assign(cloud.points_S.size(), kStaticLabel);
      frames.push_back(std::move(frame));
    }
    return frames;
  }
};

TEST_P(OctomapScansTest, TheScanGraph) {
  const auto path = DataPath("octomap/spherical_scan.graph");
  if (!path) GTEST_SKIP() << "only recorded scans are compared here";
  const auto clouds = ReadPointClouds(*path);
  ASSERT_TRUE(clouds.ok()) << clouds.status();
  ExpectSameStaticMap(Frames(*clouds), 0.02, {-1, GetParam()});
}

TEST_P(OctomapScansTest, TheScan) {
  const auto path = DataPath("octomap/scan.dat.bz2");
  if (!path) GTEST_SKIP() << "only recorded scans are compared here";
  const auto text = Bunzip2(*path);
  ASSERT_TRUE(text.has_value());
  const auto cloud = ParseTextCloud("scan.dat", *text);
  ASSERT_TRUE(cloud.ok()) << cloud.status();
  ExpectSameStaticMap(Frames({*cloud}), 0.05, {-1, GetParam()});
}

INSTANTIATE_TEST_SUITE_P(BothRayModes, OctomapScansTest, testing::Bool(),
                         [](const auto& mode) { return mode.param ? "Discretized" : "EveryRay"; });

}  // namespace
}  // namespace clearway
