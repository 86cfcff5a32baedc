#include <gtest/gtest.h>

#include <set>

#include "clearway/map/ray_caster.h"
#include "support/random.h"

namespace clearway {
namespace {

std::vector<VoxelKey> Walk(const Eigen::Vector3f& origin, const Eigen::Vector3f& end) {
  std::vector<VoxelKey> keys;
  WalkRay(VoxelGrid(1.0), origin, end, [&](VoxelKey key) { keys.push_back(key); });
  return keys;
}

TEST(Ray, EmptyWithinOneVoxel) {
  EXPECT_TRUE(Walk({0.1f, 0.1f, 0.1f}, {0.9f, 0.9f, 0.9f}).empty());
}

TEST(Ray, AVisitThatReturnsFalseIsTheLast) {
  std::vector<VoxelKey> keys;
  WalkRay(VoxelGrid(1.0), {0.5f, 0.5f, 0.5f}, {9.5f, 0.5f, 0.5f}, [&](VoxelKey key) {
    keys.push_back(key);
    return keys.size() < 3;
  });
  EXPECT_EQ(keys, (std::vector<VoxelKey>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
}

TEST(Ray, TellsHowManyVoxelsRaysPass) {
  const VoxelGrid grid(0.5);
  const std::vector<Eigen::Vector3f> ends{{10, 0, 0}, {0, -3, 4}, {0, 0, 0}};
  const std::vector<RayEnd> kinds(ends.size(), RayEnd::kHit);
  const Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  const RayCloud cloud{ends, kinds, {&origin, 1}};
  EXPECT_DOUBLE_EQ(VoxelsPassed(grid, cloud, {}), 20 + 14 + 3);
  RayOptions short_range;
  short_range.max_range_m = 2.5;
  EXPECT_NEAR(VoxelsPassed(grid, cloud, short_range), 5 + 7 + 3, 1e-5);
}

TEST(Ray, StopsBeforeTheEndVoxel) {
  EXPECT_EQ(Walk({0.5f, 0.5f, 0.5f}, {3.5f, 0.5f, 0.5f}),
            (std::vector<VoxelKey>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
}

TEST(Ray, IsConnectedThroughFaces) {
  testing_support::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const auto keys = Walk(random.Vector(20).cast<float>(), random.Vector(20).cast<float>());
    for (std::size_t k = 1; k < keys.size(); ++k) {
      EXPECT_EQ(std::abs(keys[k].x - keys[k - 1].x) + std::abs(keys[k].y - keys[k - 1].y) +
                    std::abs(keys[k].z - keys[k - 1].z),
                1);
    }
  }
}

struct Marks {
  std::set<VoxelKey> free, hit, end;
};
Marks Cast(std::vector<Eigen::Vector3f> ends, std::vector<RayEnd> kinds,
           const RayOptions& options) {
  ThreadPool pool(1);
  const Eigen::Vector3f origin(0.5f, 0.5f, 0.5f);
  const ScanUpdate update =
      RayCaster(pool).Cast(VoxelGrid(1.0), {ends, kinds, {&origin, 1}}, options).value();
  Marks marks;
  for (BlockKey key : update.keys()) {
    const auto& block = *update.Find(key);
    block.free.ForEach([&](int i) { marks.free.insert(VoxelAt(key, i)); });
    block.hit.ForEach([&](int i) { marks.hit.insert(VoxelAt(key, i)); });
    block.end.ForEach([&](int i) { marks.end.insert(VoxelAt(key, i)); });
  }
  return marks;
}

TEST(CastRays, EmptyCloud) { EXPECT_TRUE(Cast({}, {}, {}).free.empty()); }

TEST(CastRays, BeyondTheRangeClearsUpToItAndHitsNothing) {
  const Marks marks = Cast({{10.5f, 0.5f, 0.5f}}, {RayEnd::kHit}, {3.0, false});
  EXPECT_EQ(marks.free, (std::set<VoxelKey>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_TRUE(marks.hit.empty());
  EXPECT_TRUE(marks.end.empty());
  const RayOptions octomap{.max_range_m = 3, .octomap_ends = true};
  EXPECT_EQ(Cast({{10.5f, 0.5f, 0.5f}}, {RayEnd::kHit}, octomap).free,
            (std::set<VoxelKey>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
}

// The point beyond the range may be in the voxel that the cut ray ends in.
TEST(CastRays, BeyondTheRangeDoesNotClearTheVoxelOfItsPoint) {
  const Marks marks = Cast({{3.9f, 0.5f, 0.5f}}, {RayEnd::kHit}, {3.0, false});
  EXPECT_EQ(marks.free, (std::set<VoxelKey>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  EXPECT_TRUE(marks.hit.empty());
}

TEST(CastRays, ABlockedRayEndsWithoutAHit) {
  const Marks marks = Cast({{2.5f, 0.5f, 0.5f}}, {RayEnd::kBlock}, {});
  EXPECT_TRUE(marks.hit.empty());
  EXPECT_EQ(marks.end, (std::set<VoxelKey>{{2, 0, 0}}));
}

TEST(CastRays, WithOctomapEndsANoReturnLeavesItsEndAlone) {
  const Marks marks = Cast({{2.5f, 0.5f, 0.5f}}, {RayEnd::kClear}, {.octomap_ends = true});
  EXPECT_EQ(marks.free.size(), 2u);
  EXPECT_TRUE(marks.end.empty());
}

TEST(CastRays, DiscretizedCastsOneRayPerEndVoxelToItsCentre) {
  const std::vector<Eigen::Vector3f> ends{{5.9f, 5.1f, 0.5f}, {5.1f, 5.9f, 0.5f}};
  const std::vector<RayEnd> kinds(2, RayEnd::kHit);
  const Marks centre = Cast({{5.5f, 5.5f, 0.5f}}, {RayEnd::kHit}, {-1, true});
  EXPECT_EQ(Cast(ends, kinds, {-1, true}).free, centre.free);
  EXPECT_GT(Cast(ends, kinds, {-1, false}).free.size(), centre.free.size());
}

TEST(CastRays, OneOriginPerPoint) {
  ThreadPool pool(2);
  const std::vector<Eigen::Vector3f> ends{{2.5f, 0.5f, 0.5f}, {2.5f, 9.5f, 0.5f}};
  const std::vector<Eigen::Vector3f> origins{{0.5f, 0.5f, 0.5f}, {0.5f, 9.5f, 0.5f}};
  const std::vector<RayEnd> kinds(2, RayEnd::kHit);
  const ScanUpdate update =
      RayCaster(pool).Cast(VoxelGrid(1.0), {ends, kinds, origins}, {}).value();
  EXPECT_EQ(update.Find({0, 0, 0})->free.Count(), 2);
  EXPECT_EQ(update.Find({0, 1, 0})->free.Count(), 2);
}

}  // namespace
}  // namespace clearway
