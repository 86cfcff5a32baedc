#include "map/window_walk.h"

#include <gtest/gtest.h>

#include <set>

#include "clearway/map/ray.h"
#include "map/avx512.h"
#include "map/bit_window.h"
#include "map/ray_lanes.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kResolution_m = 0.1;
const BlockKey kFirst{-16, -16, -16}, kLast{15, 15, 15};  // 12.8 m to each side

struct Case {
  const char* name;
  WindowWalk walk;
  bool (*available)();
};

class WindowWalkTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (!GetParam().available()) GTEST_SKIP() << "not on this processor";
    window_.Cover(kFirst, kLast);
  }
  void Add(const Eigen::Vector3f& origin, const Eigen::Vector3f& end) {
    WalkRay(grid_, origin, end, [&](VoxelKey key) { expected_.insert(key); });
    const int lane = count_++ % kLanes;
    if (lane == 0) segments_.push_back({});  // the other lanes go nowhere
    Put({origin, end}, lane, segments_.back());
  }
  void ExpectSameVoxels() {
    std::vector<WindowRays> rays(segments_.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RayLanes started;
      StartLanes(grid_, segments_[i], started);
      PlaceInWindow(started, window_, rays[i]);
    }
    GetParam().walk(rays, window_.words());
    std::vector<BitWindow::Block> blocks;
    for (std::size_t row = 0; row < window_.rows(); ++row) {
      window_.TakeRow(row, blocks);
    }
    std::set<VoxelKey> visited;
    for (const BitWindow::Block& block : blocks) {
      block.mask.ForEach([&](int i) { visited.insert(VoxelAt(block.key, i)); });
    }
    EXPECT_EQ(visited, expected_);
    segments_.clear();
    count_ = 0;
    expected_.clear();
  }

  const VoxelGrid grid_{kResolution_m};
  BitWindow window_;
  std::vector<RaySegments> segments_;
  int count_ = 0;  // of the rays in them
  std::set<VoxelKey> expected_;
};

TEST_P(WindowWalkTest, EmptyWithoutRays) { ExpectSameVoxels(); }

TEST_P(WindowWalkTest, VisitsTheVoxelsOfWalkRay) {
  Random random(3);
  // Fewer rays than lanes, as many, and many more.
  for (const int count : {1, 2, 7, 8, 23, 24, 25, 1000}) {
    for (int i = 0; i < count; ++i) {
      Add(random.Vector(3).cast<float>(), random.Vector(12).cast<float>());
    }
    ExpectSameVoxels();
  }
}

// The rays between them have ended before they begin.
TEST_P(WindowWalkTest, PassesOverRaysThatGoNowhere) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f origin = random.Vector(3).cast<float>();
    const bool stays = i < 20 || random.Integer(0, 2) > 0;
    Add(origin, stays ? origin : random.Vector(12).cast<float>());
  }
  ExpectSameVoxels();
}

TEST_P(WindowWalkTest, RaysAlongAxesAndThroughBorders) {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    Eigen::Vector3d origin = random.Vector(3), end = random.Vector(12);
    for (int axis = 0; axis < 3; ++axis) {
      if (random.Integer(0, 2) == 0) end[axis] = origin[axis];
      if (random.Integer(0, 3) == 0) end[axis] = std::round(10 * end[axis]) / 10;
      if (random.Integer(0, 3) == 0) origin[axis] = std::round(10 * origin[axis]) / 10;
    }
    Add(origin.cast<float>(), end.cast<float>());
  }
  ExpectSameVoxels();
}

INSTANTIATE_TEST_SUITE_P(Kernels, WindowWalkTest,
                         testing::Values(Case{"Portable", WalkWindowPortable, [] { return true; }},
                                         Case{"Avx512", WalkWindowAvx512, HasAvx512},
                                         Case{"AbreastAvx512", WalkWindowAbreastAvx512, HasAvx512}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace clearway
