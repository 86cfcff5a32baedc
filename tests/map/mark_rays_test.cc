#include "map/mark_rays.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "clearway/map/ray.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kResolution_m = 0.05;

std::set<VoxelKey> TakeAll(BitWindow& window) {
  std::vector<BitWindow::Block> blocks;
  for (std::size_t row = 0; row < window.rows(); ++row) window.TakeRow(row, blocks);
  std::set<VoxelKey> voxels;
  for (const BitWindow::Block& block : blocks) {
    block.mask.ForEach([&](int i) { voxels.insert(VoxelAt(block.key, i)); });
  }
  return voxels;
}

std::set<VoxelKey> Marked(const VoxelGrid& grid, const std::vector<RaySegment>& rays) {
  BitWindow window;
  window.Cover({-16, -16, -16}, {15, 15, 15});  // 6.4 m to each side
  RayRounds rounds;
  for (const RaySegment& ray : rays) rounds.Add(ray);
  rounds.Finish();
  const auto& origins = rounds.BoxesAround().origins;
  MarkRays(grid, rounds, origins.min() == origins.max(), window);
  return TakeAll(window);
}

std::set<VoxelKey> MarkedShort(const VoxelGrid& grid, const std::vector<RaySegment>& rays) {
  BitWindow window;
  window.Cover({-16, -16, -16}, {15, 15, 15});
  RayEights eights;
  for (const RaySegment& ray : rays) eights.Add(ray);
  eights.Finish();
  MarkShortRays(grid, eights.eights(), window);
  return TakeAll(window);
}

std::set<VoxelKey> Walked(const VoxelGrid& grid, const std::vector<RaySegment>& rays) {
  std::set<VoxelKey> voxels;
  for (const RaySegment& ray : rays) {
    WalkRay(grid, ray.origin, ray.end, [&](VoxelKey key) { voxels.insert(key); });
  }
  return voxels;
}

// Rays in rows and columns, as a camera looking along the axis sees a jagged surface: so dense that
// most of their steps add nothing, and with gaps.
std::vector<RaySegment> Image(const Eigen::Vector3f& origin, int axis, float sign, Random& random) {
  std::vector<RaySegment> rays;
  constexpr int kPixels = 160;
  for (int v = 0; v < kPixels; ++v) {
    for (int u = 0; u < kPixels; ++u) {
      if (random.Integer(0, 9) == 0) continue;
      const float depth_m = (u / 40 + v / 40) % 2 == 0 ? 3.5f : 2 + 0.01f * static_cast<float>(u);
      Eigen::Vector3f end = origin;
      end[axis] += sign * depth_m;
      end[(axis + 1) % 3] += depth_m * (static_cast<float>(u) / kPixels - 0.5f);
      end[(axis + 2) % 3] += depth_m * (static_cast<float>(v) / kPixels - 0.5f);
      rays.push_back({origin, end});
    }
  }
  return rays;
}

TEST(MarkRays, EmptyWithoutRays) { EXPECT_TRUE(Marked(VoxelGrid(kResolution_m), {}).empty()); }

TEST(MarkRays, DenseRaysMarkWhatEachOfThemPasses) {
  const VoxelGrid grid(kResolution_m);
  Random random(4);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      const std::vector<RaySegment> rays =
          Image(random.Vector(1).cast<float>(), axis, sign, random);
      EXPECT_EQ(Marked(grid, rays), Walked(grid, rays)) << axis << " " << sign;
    }
  }
}

TEST(MarkRays, FromTheBorderOfAVoxel) {
  const VoxelGrid grid(kResolution_m);
  Random random(5);
  for (const float origin : {0.0f, 0.5f, -0.25f}) {
    const auto rays = Image(Eigen::Vector3f::Constant(origin), 0, 1, random);
    EXPECT_EQ(Marked(grid, rays), Walked(grid, rays));
  }
}

TEST(MarkRays, FromManyOrigins) {
  const VoxelGrid grid(kResolution_m);
  Random random(6);
  std::vector<RaySegment> rays = Image({0, 0, 0}, 1, 1, random);
  for (RaySegment& ray : rays) ray.origin += random.Vector(0.3).cast<float>();
  EXPECT_EQ(Marked(grid, rays), Walked(grid, rays));
}

TEST(MarkRays, FromABorderAlmostAlongAnAxis) {
  const VoxelGrid grid(0.02);
  const std::vector<RaySegment> rays{{{0, 0, 0}, {0.001f, -1e-9f, 0}},
                                     {{0, 0, 0}, {1, -4e-8f, -4e-8f}}};
  EXPECT_EQ(Marked(grid, rays), Walked(grid, rays));
}

TEST(MarkRays, TooShortForADirection) {
  const VoxelGrid grid(0.1);
  std::vector<RaySegment> rays{{{0, 0, 0}, {-1, 0, 0}}};
  for (int i = 0; i < 20; ++i) rays.push_back({{0, 0, 0}, {-1e-30f, i % 2 == 0 ? 0 : -1e-30f, 0}});
  EXPECT_EQ(Marked(grid, rays), Walked(grid, rays));
}

// At the edge of the sector, where two components are of one size, and beyond slopes of a half.
TEST(MarkRays, ToTheEdgesOfTheSector) {
  const VoxelGrid grid(kResolution_m);
  std::vector<RaySegment> rays;
  for (int u = -100; u <= 100; ++u) {
    for (int v = -100; v <= 100; ++v) {
      rays.push_back({{0.02f, 0.01f, 0.03f}, {2.52f, 0.01f + 0.025f * u, 0.03f + 0.025f * v}});
    }
  }
  EXPECT_EQ(Marked(grid, rays), Walked(grid, rays));
}

// More of them than are walked at once, the last eight incomplete, and some that go nowhere.
TEST(MarkRays, ShortRaysMarkWhatEachOfThemPasses) {
  const VoxelGrid grid(kResolution_m);
  Random random(7);
  EXPECT_TRUE(MarkedShort(grid, {}).empty());
  for (const int count : {1, 8, 9, 5000}) {
    std::vector<RaySegment> rays;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3f origin = random.Vector(5).cast<float>();
      const float length_m = 0.1f * static_cast<float>(random.Integer(0, 10));
      rays.push_back({origin, origin + length_m * random.Vector(1).cast<float>()});
    }
    EXPECT_EQ(MarkedShort(grid, rays), Walked(grid, rays)) << count;
  }
}

}  // namespace
}  // namespace clearway
