#include "map/voxel_runs.h"

#include <gtest/gtest.h>

#include <vector>

#include "map/avx512.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

struct Case {
  const char* name;
  RunKernels kernels;
  bool (*available)();
};

class VoxelRunsTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (!GetParam().available()) GTEST_SKIP() << "not on this processor";
  }

  // Cuts points in these voxels into runs and reads their states, of which every voxel has one of
  // its own.
  void ExpectRight(const std::vector<VoxelKey>& keys) {
    std::vector<Eigen::Vector3d> points;
    for (const VoxelKey& key : keys) points.push_back(grid_.CenterOf(key));
    ExpectRight(points, keys);
  }

  void ExpectRight(const std::vector<Eigen::Vector3d>& points, const std::vector<VoxelKey>& keys) {
    const std::size_t room = keys.size() + kRunsRoom;
    std::vector<std::uint16_t> indices(room);
    std::vector<std::uint32_t> firsts(room);
    std::vector<BlockKey> block_keys(room);
    const std::size_t count =
        GetParam().kernels.cut(grid_, points.data(), points.size(), points.data(), indices.data(),
                               firsts.data(), block_keys.data());
    std::vector<std::uint32_t> begins, runs;
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
      if (i == 0 || BlockOf(keys[i]) != BlockOf(keys[i - 1])) begins.push_back(i);
      runs.push_back(static_cast<std::uint32_t>(begins.size()) - 1);
      ASSERT_EQ(indices[i], IndexInBlock(keys[i])) << i;
      ASSERT_EQ(block_keys[runs[i]], BlockOf(keys[i])) << i;
    }
    ASSERT_EQ(std::vector(firsts.begin(), firsts.begin() + count), begins);
    if (keys.empty()) return;
    ASSERT_EQ(firsts[count], keys.size());

    std::vector<VoxelBlock> blocks(count);
    std::vector<const VoxelBlock*> of_runs;
    for (VoxelBlock& block : blocks) {
      for (int i = 0; i < kVoxelsPerBlock; ++i) {
        const int state = random_.Integer(0, 2);
        if (state >= 1) block.observed.Set(i);
        if (state == 2) block.occupied.Set(i);
      }
      of_runs.push_back(&block);
    }
    std::vector<VoxelState> states(room);
    GetParam().kernels.read(of_runs.data(), firsts.data(), count, indices.data(), states.data());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      ASSERT_EQ(states[i], blocks[runs[i]].State(IndexInBlock(keys[i]))) << i;
    }
  }

  const VoxelGrid grid_{0.1};
  Random random_{1};
};

TEST_P(VoxelRunsTest, NothingOfNothing) { ExpectRight({}); }

// Runs of all lengths, also across eights, on both sides of the origin.
TEST_P(VoxelRunsTest, RunsOfAllLengths) {
  for (int longest : {1, 2, 9, 40}) {
    for (std::size_t count = 1; count < 70; ++count) {
      std::vector<VoxelKey> keys;
      while (keys.size() < count) {
        const auto any = [&] { return random_.Integer(-3, 3) * kBlockSize; };
        const VoxelKey corner{any(), any(), any()};
        for (int i = random_.Integer(1, longest); i > 0 && keys.size() < count; --i) {
          const auto within = [&] { return random_.Integer(0, kBlockSize - 1); };
          keys.push_back({corner.x + within(), corner.y + within(), corner.z + within()});
        }
      }
      ExpectRight(keys);
    }
  }
}

TEST_P(VoxelRunsTest, ABlockThatDiffersAlongOneAxisAlone) {
  for (const VoxelKey& step : {VoxelKey{8, 0, 0}, VoxelKey{0, -8, 0}, VoxelKey{0, 0, 8}}) {
    std::vector<VoxelKey> keys;
    for (int i = 0; i < 40; ++i) keys.push_back({i / 3 * step.x, i / 3 * step.y, i / 3 * step.z});
    ExpectRight(keys);
  }
}

// Whose coordinates are multiples of the voxels' size, as near as they can be told.
TEST_P(VoxelRunsTest, OnBorders) {
  std::vector<Eigen::Vector3d> points;
  std::vector<VoxelKey> keys;
  while (points.size() < kRunsAtOnce) {
    const auto any = [&] { return grid_.resolution_m() * random_.Integer(-3000, 3000); };
    points.emplace_back(any(), any(), any());
    keys.push_back(grid_.KeyOf(points.back()));
  }
  ExpectRight(points, keys);
}

TEST_P(VoxelRunsTest, AsManyRunsAsPoints) {
  std::vector<VoxelKey> keys;
  for (int i = 0; i < static_cast<int>(kRunsAtOnce); ++i) keys.push_back({kBlockSize * i, 0, -i});
  ExpectRight(keys);
}

TEST_P(VoxelRunsTest, AtTheEndsOfTheGrid) {
  constexpr std::int32_t kEnd = kMaxVoxelIndex;
  ExpectRight({{-kEnd, -kEnd, -kEnd}, {kEnd - 1, kEnd - 1, kEnd - 1}, {0, 0, 0}, {-1, -1, -1}});
}

INSTANTIATE_TEST_SUITE_P(Kernels, VoxelRunsTest,
                         testing::Values(Case{"Portable", PortableRunKernels(),
                                              [] { return true; }},
                                         Case{"Avx512", Avx512RunKernels(), HasAvx512}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace clearway
