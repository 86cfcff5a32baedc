// What rays graze before they end.
#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "clearway/map/ray_caster.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

std::set<VoxelKey> MissesIn(const ScanUpdate& update) {
  std::set<VoxelKey> voxels;
  for (std::size_t i = 0; i < update.keys().size(); ++i) {
    BlockMask misses = update.block(i).free;
    misses.Subtract(update.block(i).end);
    misses.ForEach([&](int at) { voxels.insert(VoxelAt(update.keys()[i], at)); });
  }
  return voxels;
}

struct Rays {
  std::vector<Eigen::Vector3f> ends, origins;
  std::vector<RayEnd> kinds;
};

ScanUpdate UpdateBy(const Rays& rays, const VoxelMap& map, const RayOptions& options,
                    int threads = 1) {
  ThreadPool pool(threads);
  return RayCaster(pool).Cast(map, {rays.ends, rays.kinds, rays.origins}, options).value();
}

// Ground in the middle of the layer z = 0 of voxels of 0.2 m, seen all over; and a wall of 1 m on
// it, 4 m before the end of the ray, which comes from 1.6 m above and from aside.
class GrazedGround : public testing::Test {
 protected:
  GrazedGround() {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 100; ++x) map_.Set({x, y, 0}, map_.model().clamp_max);
      for (int z = 1; z < 6; ++z) map_.Set({80, y, z}, map_.model().clamp_max);
    }
  }

  std::set<VoxelKey> Missed(RayEnd kind, const RayOptions& options) const {
    return MissesIn(UpdateBy({{{19.9f, 3.1f, 0.1f}}, {{0.1f, 0.1f, 1.7f}}, {kind}}, map_, options));
  }
  static long OnGround(const std::set<VoxelKey>& voxels) {
    return std::ranges::count_if(voxels, [](VoxelKey key) { return key.z == 0; });
  }
  static long InWall(const std::set<VoxelKey>& voxels) {
    return std::ranges::count_if(voxels, [](VoxelKey key) { return key.x == 80; });
  }

  VoxelMap map_{0.2};
};

TEST_F(GrazedGround, IsMissedAsInOctomap) {
  // From 0.1 m above the ground on, which is 1.24 m before the end.
  EXPECT_EQ(OnGround(Missed(RayEnd::kHit, {})), 7);
}

TEST_F(GrazedGround, IsSparedIfAskedFor) {
  const auto all = Missed(RayEnd::kHit, {});
  const auto dut = Missed(RayEnd::kHit, {.grazing_m = 4});
  EXPECT_EQ(OnGround(dut), 0);
  EXPECT_EQ(dut.size(), all.size() - 7);
  // An object's point ends a ray as well.
  EXPECT_EQ(OnGround(Missed(RayEnd::kBlock, {.grazing_m = 4})), 0);
}

TEST_F(GrazedGround, IsMissedWhereNothingReturns) {
  EXPECT_EQ(OnGround(Missed(RayEnd::kClear, {.grazing_m = 4, .octomap_ends = true})), 7);
  EXPECT_EQ(Missed(RayEnd::kHit, {.max_range_m = 19.85, .grazing_m = 4}),
            Missed(RayEnd::kHit, {.max_range_m = 19.85}));
}

TEST_F(GrazedGround, IsSparedSoFarOnly) {
  const long left = OnGround(Missed(RayEnd::kHit, {.grazing_m = 0.7}));
  EXPECT_GE(left, 2);
  EXPECT_LE(left, 4);
}

TEST_F(GrazedGround, WhatStandsOnItIsCleared) {
  EXPECT_GE(InWall(Missed(RayEnd::kHit, {})), 1);
  EXPECT_EQ(InWall(Missed(RayEnd::kHit, {.grazing_m = 8})), InWall(Missed(RayEnd::kHit, {})));
}

// A level ray that meets a wall head on clears what is left before it.
TEST(GrazedVoxels, NotBeforeAWall) {
  VoxelMap map(0.2);
  for (int y = -3; y < 4; ++y) {
    for (int z = 0; z < 10; ++z) map.Set({50, y, z}, map.model().clamp_max);
  }
  const VoxelKey ghost{45, 0, 5};
  map.Set(ghost, map.model().clamp_max);
  const Rays rays{{{10.1f, 0.1f, 1.1f}}, {{0.1f, 0.1f, 1.1f}}, {RayEnd::kHit}};
  EXPECT_TRUE(MissesIn(UpdateBy(rays, map, {.grazing_m = 4})).contains(ghost));
}

// Seen from both sides in turn.
TEST_F(GrazedGround, IsSparedByRaysFromEverywhere) {
  const Rays rays{{{10.1f, 2.1f, 0.1f}, {10.1f, 2.1f, 0.1f}},
                  {{0.1f, 2.1f, 0.9f}, {19.9f, 2.1f, 0.9f}},
                  {RayEnd::kHit, RayEnd::kHit}};
  EXPECT_GE(OnGround(MissesIn(UpdateBy(rays, map_, {}))), 8);
  EXPECT_EQ(OnGround(MissesIn(UpdateBy(rays, map_, {.grazing_m = 4}))), 0);
}

// Whatever lies between the two, and many rays are looked at together.
TEST_F(GrazedGround, OfRaysInARowTheFirstAloneIsLookedAt) {
  const Eigen::Vector3f origin(0.1f, 0.1f, 1.7f), above = origin + Eigen::Vector3f(0, 0, 3);
  for (const std::size_t between : {1, 100, 4094, 4095, 4096, 9000}) {
    Rays rays{{{19.9f, 3.01f, 0.1f}}, {origin}, {RayEnd::kHit}};
    rays.ends.resize(1 + between, above);
    rays.kinds.resize(1 + between, RayEnd::kClear);
    rays.ends.push_back({19.9f, 3.19f, 0.1f});
    rays.kinds.push_back(RayEnd::kHit);
    EXPECT_GT(OnGround(MissesIn(UpdateBy(rays, map_, {.grazing_m = 4}, 2))), 0) << between;
    rays.kinds[between] = RayEnd::kHit;  // no longer in a row
    EXPECT_EQ(OnGround(MissesIn(UpdateBy(rays, map_, {.grazing_m = 4}, 2))), 0) << between;
  }
}

// By definition, ray by ray; more of them than are looked at together.
TEST(GrazedVoxels, OfRandomRaysAndMaps) {
  Random random(5);
  VoxelMap map(0.1);
  for (int i = 0; i < 20'000; ++i) {
    map.Set(map.grid().KeyOf(random.Vector(2)), map.model().clamp_max);
  }
  Rays rays;
  rays.origins = {{0.03f, 0.02f, -0.01f}};
  for (int i = 0; i < 5'000; ++i) {
    rays.ends.push_back(random.Vector(3).cast<float>());
    rays.kinds.push_back(static_cast<RayEnd>(i % 3));
    if (i % 4 != 0) continue;  // else one beside it, which may end in the same voxel
    rays.ends.push_back(rays.ends.back() + random.Vector(0.05).cast<float>());
    rays.kinds.push_back(rays.kinds.back());
  }
  const RayOptions options{.max_range_m = 2.5, .grazing_m = 0.8};
  std::set<VoxelKey> expected = MissesIn(UpdateBy(rays, map, {.max_range_m = 2.5}));
  const std::size_t all = expected.size();
  VoxelKey last;
  int in_a_row = 0;
  for (std::size_t i = 0; i < rays.ends.size(); ++i) {
    const Eigen::Vector3f back = rays.origins[0] - rays.ends[i];
    if (rays.kinds[i] == RayEnd::kClear || back.norm() > 2.5f) continue;
    const VoxelKey end = map.grid().KeyOf(rays.ends[i].cast<double>());
    in_a_row += end == last;
    if (std::exchange(last, end) == end) continue;
    const float length_m = std::min(back.norm(), 0.8f);
    const auto occupied = [&](int axis, int step) {
      VoxelKey beside = end;
      (axis == 0 ? beside.x : axis == 1 ? beside.y : beside.z) += step;
      return map.State(beside) == VoxelState::kOccupied;
    };
    bool across[3];
    for (int axis = 0; axis < 3; ++axis) across[axis] = !occupied(axis, 1) && !occupied(axis, -1);
    bool in_a_layer = true;
    WalkRay(map.grid(), rays.ends[i], rays.ends[i] + length_m * back.normalized(),
            [&](VoxelKey key) {
              in_a_layer &= key.x == end.x || key.y == end.y || key.z == end.z;
              const bool grazed = (across[0] && key.x == end.x) || (across[1] && key.y == end.y) ||
                                  (across[2] && key.z == end.z);
              if (in_a_layer && grazed && map.State(key) == VoxelState::kOccupied) {
                expected.erase(key);
              }
            });
  }
  EXPECT_LT(expected.size(), all - 100);
  EXPECT_GT(in_a_row, 80);
  for (const int threads : {1, 3}) {
    EXPECT_EQ(MissesIn(UpdateBy(rays, map, options, threads)), expected);
  }
}

}  // namespace
}  // namespace clearway
