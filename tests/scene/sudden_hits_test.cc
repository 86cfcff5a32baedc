#include "scene/sudden_hits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr int kAcross = 24, kFirst = -12;  // over several blocks, and over the origin

template <class Visit>
void ForEachNear(VoxelKey key, int reach, Visit&& visit) {
  for (int z = key.z - reach; z <= key.z + reach; ++z) {
    for (int y = key.y - reach; y <= key.y + reach; ++y) {
      for (int x = key.x - reach; x <= key.x + reach; ++x) visit(VoxelKey{x, y, z});
    }
  }
}

template <class Visit>
void ForEachOfWorld(Visit&& visit) {
  ForEachNear({kFirst + kAcross / 2, kFirst + kAcross / 2, kFirst + kAcross / 2}, kAcross / 2,
              visit);
}

struct World {
  VoxelMap lasting_W{0.1};
  DynamicSpace dynamic_W;
  ScanUpdate update;
};

// Most of it free for long, with a few surfaces and hits, more or fewer.
World AnyWorld(Random& random) {
  World world;
  const OccupancyModel& model = world.lasting_W.model();
  const double occupied = random.Uniform(0, 0.01), hit = random.Uniform(0, 0.05);
  std::vector<DynamicVoxel> dynamic;
  ForEachOfWorld([&](VoxelKey key) {
    const double kind = random.Uniform(0, 1);
    if (kind < occupied) {
      world.lasting_W.Set(key, model.clamp_max);
    } else if (kind < 0.9) {
      world.lasting_W.Set(key, kind < 0.85 ? model.clamp_min : model.miss);
    }
    if (random.Uniform(0, 1) < hit) world.update.MarkHit(key);
    if (random.Uniform(0, 1) < 0.001) dynamic.push_back({key, {}, {}});
  });
  std::ranges::sort(dynamic, ComesBefore, &DynamicVoxel::key);
  world.dynamic_W = DynamicSpace(dynamic);
  return world;
}

bool IsHit(const ScanUpdate& update, VoxelKey key) {
  const ScanUpdate::Block* block = update.Find(BlockOf(key));
  return block != nullptr && block->hit.Test(IndexInBlock(key));
}

bool IsSudden(const World& world, VoxelKey key) {
  const auto is_hit_though_free = [&](VoxelKey voxel) {
    return IsHit(world.update, voxel) &&
           world.lasting_W.Find(voxel) == world.lasting_W.model().clamp_min;
  };
  if (!is_hit_though_free(key)) return false;
  int company = 0, surface = 0;
  ForEachNear(key, 2, [&](VoxelKey near) {
    company += is_hit_though_free(near);
    surface += world.lasting_W.State(near) == VoxelState::kOccupied;
  });
  return world.dynamic_W.Find(key) != nullptr || (company >= 3 && surface == 0);
}

TEST(SuddenHits, AreThoseOfALookAtEachVoxel) {
  Random random(11);
  std::size_t found = 0;
  for (int round = 0; round < 20; ++round) {
    const World world = AnyWorld(random);
    std::vector<VoxelKey> expected;
    ForEachOfWorld([&](VoxelKey key) {
      if (IsSudden(world, key)) expected.push_back(key);
    });
    std::ranges::sort(expected, ComesBefore);
    EXPECT_EQ(SuddenHits(world.lasting_W, world.dynamic_W, world.update), expected);
    found += expected.size();
  }
  EXPECT_GT(found, 500u);
}

}  // namespace
}  // namespace clearway
