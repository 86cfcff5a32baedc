#include "scene/voxel_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;
using Points = std::vector<Eigen::Vector3d>;

// How far the points reach in a direction: their hull has no other content.
double Support(const Points& points, const Eigen::Vector3d& direction) {
  double most = std::numeric_limits<double>::lowest();
  for (const Eigen::Vector3d& p : points) most = std::max(most, direction.dot(p));
  return most;
}

Eigen::Vector3d WholeVector(Random& random, int most) {
  return {static_cast<double>(random.Integer(-most, most)),
          static_cast<double>(random.Integer(-most, most)),
          static_cast<double>(random.Integer(-most, most))};
}

void ExpectSameHull(const Points& a, const Points& b, Random& random) {
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d direction = WholeVector(random, 9);
    ASSERT_EQ(Support(a, direction), Support(b, direction)) << direction.transpose();
  }
}

Points CornersOf(const VoxelMap& map) {
  Points corners;
  map.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
    block.occupied.ForEach([&](int index) {
      const auto [x, y, z] = VoxelAt(key, index);
      for (int i = 0; i < 8; ++i) corners.emplace_back(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
    });
  });
  return corners;
}

TEST(VoxelHull, CandidatesHaveTheHullOfAllCorners) {
  Random random(1);
  EXPECT_TRUE(HullCandidates(VoxelMap(0.1)).empty());
  for (const int voxels : {1, 2, 5, 40, 500}) {
    VoxelMap map(0.1);
    for (int i = 0; i < voxels; ++i) {
      map.Set({random.Integer(-12, 12), random.Integer(-9, 9), random.Integer(-6, 6)}, 100);
    }
    map.Set({20, 20, 20}, -100);  // free: not a part of it
    const Points corners = CornersOf(map), candidates = HullCandidates(map);
    ExpectSameHull(candidates, corners, random);
    EXPECT_LE(candidates.size(), corners.size());
  }
}

// Of a solid box, only its corners are left.
TEST(VoxelHull, EightCandidatesForABox) {
  VoxelMap map(0.1);
  for (int x = -3; x < 12; ++x) {
    for (int y = 2; y < 9; ++y) {
      for (int z = -2; z < 4; ++z) map.Set({x, y, z}, 100);
    }
  }
  EXPECT_EQ(HullCandidates(map).size(), 8);
}

TEST(VoxelHull, OutlinesHaveTheHullOfAllPoints) {
  Random random(2);
  for (const int count : {1, 2, 3, 10, 300}) {
    Points points;
    for (int i = 0; i < count; ++i) points.push_back(WholeVector(random, 5) / 4);
    Points outlines = points;
    KeepOutlines(outlines);
    ExpectSameHull(outlines, points, random);
    EXPECT_TRUE(std::ranges::is_sorted(outlines, {}, [](const auto& p) { return p.z(); }));
  }
}

TEST(VoxelHull, OutlinesHoldNoPointTwiceAndNoneBetweenOthers) {
  Points points = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {2, 2, 0}, {0, 0, 0}, {5, 0, 1}, {5, 0, 1}};
  KeepOutlines(points);
  EXPECT_EQ(points, (Points{{0, 0, 0}, {2, 2, 0}, {5, 0, 1}}));
}

}  // namespace
}  // namespace clearway
