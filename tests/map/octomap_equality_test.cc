// Our maps hold the same voxels as OctoMap's, walk and all.
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include "clearway/map/ray_caster.h"
#include "clearway/map/voxel_map.h"
#include "support/octomap_oracle.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

struct Case {
  double resolution_m;
  double max_range_m;
  bool discretize;
  int threads;
};

class OctomapEqualityTest : public testing::TestWithParam<Case> {};

std::vector<Eigen::Vector3f> RandomCloud(Random& random, int size) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < size; ++i) {
    Eigen::Vector3d p = random.Vector(6);
    if (i % 10 == 0) p = p.array().round();  // on voxel borders
    if (i % 17 == 0) p.y() = 0;              // rays along an axis
    points.push_back(p.cast<float>());
  }
  return points;
}

TEST_P(OctomapEqualityTest, SameVoxelsOverManyScans) {
  const Case& c = GetParam();
  Random random(7);
  ThreadPool pool(c.threads);
  RayCaster caster(pool);
  VoxelMap dut(c.resolution_m);
  octomap::OcTree oracle(c.resolution_m);
  for (int scan = 0; scan < 8; ++scan) {
    const Eigen::Vector3f origin =
        scan == 0 ? Eigen::Vector3f::Zero() : random.Vector(2).cast<float>().eval();
    const auto points = RandomCloud(random, 1500);
    const std::vector<RayEnd> kinds(points.size(), RayEnd::kHit);
    const RayOptions options{
        .max_range_m = c.max_range_m, .discretize = c.discretize, .octomap_ends = true};
    dut.Update(caster.Cast(dut.grid(), {points, kinds, {&origin, 1}}, options).value(), pool);
    oracle.insertPointCloud(testing_support::ToOctomap(points), testing_support::ToOctomap(origin),
                            c.max_range_m, false, c.discretize);
  }
  const auto comparison = testing_support::Compare(dut, oracle);
  EXPECT_GT(comparison.voxels, 10'000);
  EXPECT_EQ(comparison.state_differences, 0);
  EXPECT_LT(comparison.largest_log_odds_error, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Modes, OctomapEqualityTest,
                         testing::Values(Case{0.1, -1, false, 1}, Case{0.1, -1, true, 1},
                                         Case{0.1, 4.0, false, 2}, Case{0.1, 4.0, true, 2},
                                         Case{0.23, -1, false, 3}, Case{0.05, 5.0, true, 1}),
                         [](const auto& mode) { return "Case" + std::to_string(mode.index); });

TEST(OctomapEquality, EmptyMapsAreEqual) {
  octomap::OcTree oracle(0.1);
  EXPECT_EQ(testing_support::Compare(VoxelMap(0.1), oracle).voxels, 0);
}

TEST(OctomapEquality, TheOracleNoticesADifference) {
  octomap::OcTree oracle(0.1);
  VoxelMap dut(0.1);
  dut.Set({1, 2, 3}, 100);
  EXPECT_EQ(testing_support::Compare(dut, oracle).state_differences, 1);
  oracle.updateNode(octomap::point3d(0.15f, 0.25f, 0.35f), false);
  EXPECT_EQ(testing_support::Compare(dut, oracle).state_differences, 1);
}

}  // namespace
}  // namespace clearway
