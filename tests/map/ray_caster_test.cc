// Clouds of rays against a walk along each.
#include "clearway/map/ray_caster.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

std::set<VoxelKey> FreeIn(const ScanUpdate& update) {
  std::set<VoxelKey> voxels;
  for (std::size_t i = 0; i < update.keys().size(); ++i) {
    update.block(i).free.ForEach([&](int at) { voxels.insert(VoxelAt(update.keys()[i], at)); });
  }
  return voxels;
}

// More rays than are dealt to rounds at once, and not a multiple of them.
void ExpectWalkOfEach(const std::vector<Eigen::Vector3f>& origins,
                      const std::vector<Eigen::Vector3f>& ends, double resolution_m) {
  const VoxelGrid grid(resolution_m);
  std::set<VoxelKey> expected;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    WalkRay(grid, origins.size() == 1 ? origins[0] : origins[i], ends[i],
            [&](VoxelKey key) { expected.insert(key); });
  }
  std::set<VoxelKey> with_ends = expected;
  for (const Eigen::Vector3f& end : ends) with_ends.insert(grid.KeyOf(end.cast<double>()));
  const std::vector<RayEnd> kinds(ends.size(), RayEnd::kClear);
  for (const int threads : {1, 3}) {
    ThreadPool pool(threads);
    const RayCloud cloud{ends, kinds, origins};
    const RayOptions octomap{.octomap_ends = true};
    EXPECT_EQ(FreeIn(RayCaster(pool).Cast(grid, cloud, octomap).value()), expected);
    EXPECT_EQ(FreeIn(RayCaster(pool).Cast(grid, cloud, {}).value()), with_ends);
  }
}

std::vector<Eigen::Vector3f> Points(std::size_t count, double within_m, Random& random) {
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(random.Vector(within_m).cast<float>());
  return points;
}

TEST(RayCaster, FromOneOrigin) {
  Random random(1);
  for (const std::size_t count : {1, 104, 2'000}) {
    ExpectWalkOfEach({{0.3f, 0.2f, -0.1f}}, Points(count, 5, random), 0.1);
  }
}

TEST(RayCaster, FromAnOriginForEach) {
  Random random(2);
  const auto ends = Points(2'000, 5, random);
  ExpectWalkOfEach(Points(ends.size(), 0.5, random), ends, 0.1);
}

// Farther than any window of bits reaches.
TEST(RayCaster, FarRays) {
  Random random(3);
  ExpectWalkOfEach({{0, 0, 0}}, Points(250, 3'000, random), 1);
}

// A few rays across all of a fine grid would fill the memory.
TEST(RayCaster, RaysThroughTooManyBlocks) {
  Random random(4);
  const VoxelGrid grid(0.1);
  const Eigen::Vector3f origin(0.3f, 0.2f, -0.1f);
  const auto near = Points(500, 5, random), far = Points(20, 90'000, random);
  const std::vector<RayEnd> kinds(near.size(), RayEnd::kClear);
  for (const int threads : {1, 3}) {
    ThreadPool pool(threads);
    RayCaster dut(pool);
    const auto cast = [&](const std::vector<Eigen::Vector3f>& ends) {
      return dut.Cast(grid, {ends, std::span(kinds).first(ends.size()), {&origin, 1}}, {});
    };
    const auto before = cast(near);
    EXPECT_FALSE(cast(far));
    EXPECT_EQ(FreeIn(*cast(near)), FreeIn(*before));  // nothing is left of what was refused
  }
}

// Rays of no length pass through nothing.
TEST(RayCaster, EndsInTooManyBlocks) {
  std::vector<Eigen::Vector3f> ends;
  for (int x = 0; x < 1025; ++x) {
    for (int y = 0; y < 1024; ++y) ends.push_back({8 * x + 0.5f, 8 * y + 0.5f, 0.5f});
  }
  const std::vector<RayEnd> kinds(ends.size(), RayEnd::kHit);
  ThreadPool pool(2);
  RayCaster dut(pool);
  const auto cast = [&](std::size_t count) {
    const std::span<const Eigen::Vector3f> some(ends.data(), count);
    return dut.Cast(VoxelGrid(1), {some, std::span(kinds).first(count), some}, {});
  };
  EXPECT_FALSE(cast(kMaxScanBlocks + 1));
}

// Each sector has few enough, all of them have too many.
TEST(RayCaster, SectorsTogetherPassThroughTooManyBlocks) {
  const VoxelGrid grid(0.1);
  const Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  std::vector<Eigen::Vector3f> ends;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float end : {-90'000.0f, 90'000.0f})
      ends.push_back(end * Eigen::Vector3f::Unit(axis));
  }
  const std::vector<RayEnd> kinds(2 * ends.size(), RayEnd::kClear);
  for (const int threads : {1, 3}) {
    ThreadPool pool(threads);
    RayCaster dut(pool);
    const auto cast = [&] {
      return dut.Cast(grid, {ends, std::span(kinds).first(ends.size()), {&origin, 1}}, {});
    };
    ASSERT_EQ(ends.size(), 6u);
    const auto six = cast();  // of 112,500 blocks each
    ASSERT_TRUE(six);
    EXPECT_NEAR(static_cast<double>(six->keys().size()), 6 * 112'500, 20);
    EXPECT_LT(six->keys().size(), kMaxScanBlocks);
    for (int i = 0; i < 6; ++i) ends.push_back(ends[i] + Eigen::Vector3f::Constant(100));
    EXPECT_FALSE(cast());
    ends.resize(6);
  }
}

}  // namespace
}  // namespace clearway
