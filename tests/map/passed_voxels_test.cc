#include "map/passed_voxels.h"

#include <gtest/gtest.h>

#include <vector>

#include "absl/container/flat_hash_set.h"
#include "clearway/map/ray.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

const VoxelGrid kGrid(0.1);

std::vector<BitWindow::Block> RandomCandidates(Random& random) {
  std::vector<BitWindow::Block> candidates;
  for (int x = -6; x < 6; ++x) {
    for (int y = -6; y < 6; ++y) {
      BitWindow::Block& block = candidates.emplace_back(BitWindow::Block{{x, y, x % 3}, {}});
      for (int i = random.Integer(0, 40); i > 0; --i) block.mask.Set(random.Integer(0, 511));
    }
  }
  return candidates;
}

// By definition.
std::vector<BlockMask> Visited(const std::vector<BitWindow::Block>& candidates,
                               const std::vector<RaySegment>& rays) {
  absl::flat_hash_set<VoxelKey> visited;
  for (const RaySegment& ray : rays) {
    WalkRay(kGrid, ray.origin, ray.end, [&](VoxelKey key) { visited.insert(key); });
  }
  std::vector<BlockMask> masks(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].mask.ForEach([&](int at) {
      if (visited.contains(VoxelAt(candidates[i].key, at))) masks[i].Set(at);
    });
  }
  return masks;
}

std::vector<BlockMask> Passed(const std::vector<BitWindow::Block>& candidates,
                              const std::vector<RaySegment>& rays, PassedVoxels& dut,
                              int threads = 1) {
  ThreadPool pool(threads);
  dut.Clear();
  for (const RaySegment& ray : rays) dut.Add(ray, RaySector::IndexOf(ray.end - ray.origin));
  return dut.Among(candidates, kGrid, pool);
}

TEST(PassedVoxels, NoneWithoutRays) {
  Random random(1);
  PassedVoxels dut;
  const auto candidates = RandomCandidates(random);
  for (const BlockMask& mask : Passed(candidates, {}, dut)) EXPECT_FALSE(mask.Any());
}

TEST(PassedVoxels, ThoseThatWalksVisitSearchAfterSearch) {
  Random random(2);
  PassedVoxels dut;
  for (int round = 0; round < 5; ++round) {
    const auto candidates = RandomCandidates(random);
    std::vector<RaySegment> rays;
    for (int i = 0; i < 300; ++i) {
      rays.push_back({random.Vector(5).cast<float>(), random.Vector(5).cast<float>()});
    }
    rays.push_back({rays[0].end, rays[0].end});  // goes nowhere
    const std::vector<BlockMask> expected = Visited(candidates, rays);
    EXPECT_EQ(Passed(candidates, rays, dut), expected);
    EXPECT_EQ(Passed(candidates, rays, dut, 3), expected);
  }
}

TEST(PassedVoxels, WhereNoWindowFits) {
  Random random(3);
  PassedVoxels dut;
  const auto candidates = RandomCandidates(random);
  const Eigen::Vector3f far(2000, 1900, 1800);
  ASSERT_FALSE(BitWindow::Fits({0, 0, 0}, BlockOf(kGrid.KeyOf(far.cast<double>()))));
  std::vector<RaySegment> rays = {{-far, far}};
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f p = random.Vector(5).cast<float>();
    rays.push_back({p, p + Eigen::Vector3f(4, 3, 2)});
  }
  EXPECT_EQ(Passed(candidates, rays, dut), Visited(candidates, rays));
}

}  // namespace
}  // namespace clearway
