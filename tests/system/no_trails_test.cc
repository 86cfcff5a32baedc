// Nothing of a moving object is ever written as occupied into the static map.
#include <gtest/gtest.h>

#include <iostream>
#include <set>

#include "clearway/io/lidar_folder.h"
#include "clearway/scene/object_extent.h"
#include "clearway/scene/scene_builder.h"
#include "clearway/sim/scenarios.h"
#include "support/data_folder.h"

namespace clearway {
namespace {

// Applies frames and remembers which static voxels points of each kind ended in.
class TrailWatch {
 public:
  explicit TrailWatch(const SceneParams& params)
      : builder_(params, {}, pool_), grid_(params.resolution_m) {}

  void Apply(const Frame& frame) {
    const ScenePtr before = builder_.Publish();
    ASSERT_TRUE(builder_.Apply(frame).ok());
    std::set<VoxelKey> static_ends, moving_ends;
    for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
      if (frame.labels[i] == kIgnoreLabel || (!frame.no_return.empty() && frame.no_return[i]))
        continue;
      const Eigen::Vector3f p_W = (frame.T_W_S * frame.points_S[i].cast<double>()).cast<float>();
      auto& ends = frame.labels[i] == kStaticLabel ? static_ends : moving_ends;
      ends.insert(grid_.KeyOf(p_W.cast<double>()));
    }
    CountRaised(before->static_map_W, builder_.Publish()->static_map_W, static_ends, moving_ends);
    static_ends_.merge(static_ends);
    moving_ends_.merge(moving_ends);
  }

  // How often a scan raised a static voxel in which only points of moving objects ended.
  int raised() const { return raised_; }

  // Occupied static voxels in which only points of moving objects ever ended; also how many there
  // could have been.
  std::pair<int, int> Trails() {
    const ScenePtr scene = builder_.Publish();
    int trails = 0, candidates = 0;
    for (const VoxelKey& key : moving_ends_) {
      if (static_ends_.contains(key)) continue;
      ++candidates;
      trails += scene->static_map_W.State(key) == VoxelState::kOccupied;
    }
    return {trails, candidates};
  }
  SceneBuilder& builder() { return builder_; }

 private:
  void CountRaised(const VoxelMap& before, const VoxelMap& after,
                   const std::set<VoxelKey>& static_ends, const std::set<VoxelKey>& moving_ends) {
    for (const VoxelKey& key : moving_ends) {
      if (static_ends.contains(key)) continue;
      const auto value = after.Find(key);
      raised_ += value && *value > before.Find(key).value_or(0);
    }
  }

  ThreadPool pool_{2};
  SceneBuilder builder_;
  VoxelGrid grid_;
  std::set<VoxelKey> static_ends_, moving_ends_;
  int raised_ = 0;
};

// Small sensors and few frames: a trail would show at once.
ScenarioOptions QuickOptions(const std::string& scenario) {
  ScenarioOptions options;
  options.frame_count = 30;
  if (scenario == "lab") {
    options.image_width_px = 160;
  } else {
    options.beams = 16;
    options.azimuth_steps = 512;
  }
  return options;
}

class NoTrailsTest : public testing::TestWithParam<const char*> {};

TEST_P(NoTrailsTest, InSimulationWithExactMotions) {
  const auto simulation = MakeScenario(GetParam(), QuickOptions(GetParam()));
  ASSERT_TRUE(simulation.ok()) << simulation.status();
  SceneParams params;
  params.resolution_m = params.object_resolution_m = simulation->spec().resolution_m;
  TrailWatch dut(params);
  for (std::size_t k = 0; k < simulation->frame_count(); ++k) dut.Apply(simulation->MakeFrame(k));
  const auto [trails, candidates] = dut.Trails();
  EXPECT_GT(candidates, 100);
  EXPECT_EQ(trails, 0);
  EXPECT_EQ(dut.raised(), 0);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, NoTrailsTest, testing::Values("crossing", "street", "lab"),
                         [](const auto& scenario) { return std::string(scenario.param); });

class RealDriveTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto data = DataFolder();
    if (!data) return;
    auto folder = OpenLidarFolder(*data / "kitti0000_fov");
    ASSERT_TRUE(folder.ok()) << folder.status();
    folder_ = *std::move(folder);
  }
  std::optional<LidarFolder> folder_;
};

TEST_F(RealDriveTest, NoTrailsAndTheVanHasItsSize) {
  if (!folder_) GTEST_SKIP() << "no recorded drive; the scenarios above stand for it";
  SceneParams params;
  params.rays.max_range_m = 50;
  TrailWatch dut(params);
  Eigen::Vector3d van_size_m = Eigen::Vector3d::Zero();
  std::shared_ptr<const MovingObject> van;
  for (std::size_t k = 0; k < folder_->frames.frame_count; ++k) {
    const auto frame = folder_->frames.read(k);
    ASSERT_TRUE(frame.ok()) << frame.status();
    dut.Apply(*frame);
    for (const auto& object : dut.builder().Publish()->objects) {
      if (object->id == 1) van = object;
    }
  }
  for (const RecordedBox& box : folder_->boxes) {
    if (box.id == 1) van_size_m = box.size_m;
  }
  const auto [trails, candidates] = dut.Trails();
  EXPECT_GT(candidates, 1000);
  EXPECT_EQ(trails, 0);
  EXPECT_EQ(dut.raised(), 0);
  ASSERT_NE(van, nullptr);
  const ObjectExtent extent = ExtentOf(*van);
  std::cout << "van " << van_size_m.transpose() << " m, its map " << extent.size_m.transpose()
            << " m, " << van->map_O.occupied_count() << " voxels, " << van->frames_seen
            << " frames\n";
  EXPECT_LT((extent.size_m - van_size_m).cwiseAbs().maxCoeff(), 0.2);
}

}  // namespace
}  // namespace clearway
