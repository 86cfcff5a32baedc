#include "map/ray_lanes.h"

#include <gtest/gtest.h>

#include <array>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

using Segments = std::array<RaySegment, kLanes>;

RayLanes Started(const VoxelGrid& grid, const Segments& segments) {
  RaySegments eight;
  for (int lane = 0; lane < kLanes; ++lane) Put(segments[lane], lane, eight);
  RayLanes lanes;
  StartLanes(grid, eight, lanes);
  return lanes;
}

// All of a batch alike but for where they are to be moved.
RayLanes Skipped(const RayLanes& rays, const LaneDoubles& until_m, std::size_t place = 0) {
  RayBatch batch;
  batch.fill(rays);
  BatchDoubles all_until_m{};
  all_until_m[place] = until_m;
  SkipLanes(batch, all_until_m);
  return batch[place];
}

VoxelKey KeyIn(const LaneInts (&key)[3], int lane) {
  return {key[0][lane], key[1][lane], key[2][lane]};
}

Segments RandomSegments(Random& random) {
  Segments segments;
  for (RaySegment& segment : segments) {
    segment = {random.Vector(5).cast<float>(), random.Vector(40).cast<float>()};
    // Along an axis, in a plane, or to where it begins.
    for (int axis = 0; axis < 3; ++axis) {
      if (random.Integer(0, 5) == 0) segment.end[axis] = segment.origin[axis];
    }
  }
  return segments;
}

TEST(RayLanes, StartsAsOneRayDoes) {
  Random random(1);
  for (const double resolution_m : {0.05, 0.1, 0.37}) {
    const VoxelGrid grid(resolution_m);
    for (int round = 0; round < 500; ++round) {
      const Segments segments = RandomSegments(random);
      const RayLanes lanes = Started(grid, segments);
      for (int lane = 0; lane < kLanes; ++lane) {
        if (segments[lane].origin == segments[lane].end) continue;  // no direction
        const RayStart one = StartRay(grid, segments[lane].origin, segments[lane].end);
        ASSERT_EQ(KeyIn(lanes.key, lane), one.key);
        ASSERT_EQ(KeyIn(lanes.end, lane), one.end);
        ASSERT_EQ(lanes.length_m[lane], one.length_m);
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_EQ(lanes.step[axis][lane], one.step[axis]);
          ASSERT_EQ(lanes.t_max[axis][lane], one.t_max[axis]);
          ASSERT_EQ(lanes.t_delta[axis][lane], one.t_delta[axis]);
        }
      }
    }
  }
}

TEST(RayLanes, RaysTooShortForADirectionStandStill) {
  Segments segments;
  segments.fill({{0, 0, 0}, {-1e-30f, -1e-30f, 0}});
  segments[1] = {{0, 0, 0}, {0, 0, 0}};
  const RayLanes lanes = Skipped(Started(VoxelGrid(0.1), segments), LaneDoubles{} + 1.0);
  for (int lane = 0; lane < kLanes; ++lane) {
    EXPECT_EQ(KeyIn(lanes.key, lane), (VoxelKey{0, 0, 0}));
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(lanes.step[axis][lane], 0);
  }
}

// On the border of a voxel the first step can lie a little before the origin: half of 0.02 is less
// in single precision.
TEST(RayLanes, StaysWhereItIsUntilNowhere) {
  Segments segments;
  segments.fill({{0, 0, 0}, {1, -4e-8f, -4e-8f}});
  RayLanes lanes = Started(VoxelGrid(0.02), segments);
  ASSERT_LT(lanes.t_max[1][0], -1e-3);
  lanes = Skipped(lanes, LaneDoubles{} - 2e-4);
  EXPECT_EQ(KeyIn(lanes.key, 0), (VoxelKey{0, 0, 0}));
}

// What WalkRay has made of the ray before `until_m`.
RayStart WalkedTo(RayStart ray, double until_m) {
  std::int32_t* const index[3] = {&ray.key.x, &ray.key.y, &ray.key.z};
  auto& t_max = ray.t_max;
  while (true) {
    const int axis =
        t_max[0] < t_max[1] ? (t_max[0] < t_max[2] ? 0 : 2) : (t_max[1] < t_max[2] ? 1 : 2);
    if (t_max[axis] >= until_m) return ray;
    *index[axis] += ray.step[axis];
    t_max[axis] += ray.t_delta[axis];
  }
}

void ExpectWalked(const VoxelGrid& grid, const Segments& segments, const LaneDoubles& until_m,
                  const RayLanes& skipped) {
  for (int lane = 0; lane < kLanes; ++lane) {
    if (segments[lane].origin == segments[lane].end) continue;
    const RayStart one =
        WalkedTo(StartRay(grid, segments[lane].origin, segments[lane].end), until_m[lane]);
    ASSERT_EQ(KeyIn(skipped.key, lane), one.key);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(skipped.t_max[axis][lane], one.t_max[axis]);
    }
  }
}

TEST(RayLanes, SkipsToWhereAWalkWouldBe) {
  const VoxelGrid grid(0.1);
  Random random(2);
  for (int round = 0; round < 500; ++round) {
    const Segments segments = RandomSegments(random);
    const RayLanes lanes = Started(grid, segments);
    LaneDoubles until_m;
    for (int lane = 0; lane < kLanes; ++lane) {
      until_m[lane] = random.Uniform(-0.2, 1) * (lanes.length_m[lane] - 0.2);
    }
    ExpectWalked(grid, segments, until_m, Skipped(lanes, until_m, round % kBatch));
  }
}

// As a camera's: all lanes of a batch make many steps.
TEST(RayLanes, SkipsAlikeWhenAllGoFar) {
  const VoxelGrid grid(0.05);
  Random random(3);
  for (int round = 0; round < 100; ++round) {
    std::array<Segments, kBatch> segments;
    RayBatch batch;
    BatchDoubles until_m;
    const Eigen::Vector3f origin = random.Vector(1).cast<float>();
    const Eigen::Vector3d middle = random.Vector(20);
    for (std::size_t i = 0; i < kBatch; ++i) {
      for (RaySegment& ray : segments[i]) {
        ray = {origin, (middle + random.Vector(0.1)).cast<float>()};
      }
      batch[i] = Started(grid, segments[i]);
      for (int lane = 0; lane < kLanes; ++lane) {
        until_m[i][lane] = random.Uniform(0.8, 1) * (batch[i].length_m[lane] - 0.2);
      }
    }
    SkipLanes(batch, until_m);
    for (std::size_t i = 0; i < kBatch; ++i) {
      ExpectWalked(grid, segments[i], until_m[i], batch[i]);
    }
  }
}

}  // namespace
}  // namespace clearway
