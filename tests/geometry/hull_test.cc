#include "clearway/geometry/hull.h"

#include <gtest/gtest.h>

#include <map>

#include "support/random.h"

namespace clearway {
namespace {

double SignedVolume(const Mesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  }
  return six / 6;
}

std::vector<Eigen::Vector3d> GridCorners(int n) {
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x <= n; ++x)
    for (int y = 0; y <= n; ++y)
      for (int z = 0; z <= n; ++z) points.emplace_back(x, y, z);
  return points;
}

TEST(Hull, EmptyForFewerThanFourPoints) {
  EXPECT_TRUE(ConvexHullOf({}).triangles.empty());
  const std::vector<Eigen::Vector3d> three(3, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(ConvexHullOf(three).triangles.empty());
}

TEST(Hull, EmptyForFlatPoints) {
  const std::vector<Eigen::Vector3d> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 2, 0}};
  EXPECT_TRUE(ConvexHullOf(flat).triangles.empty());
}

TEST(Hull, OfAVoxelGridIsItsBoxInspiteOfCoplanarPoints) {
  const Mesh dut = ConvexHullOf(GridCorners(4));
  EXPECT_NEAR(SignedVolume(dut), 64, 1e-9);
}

TEST(Hull, HoldsEveryPointAndIsClosed) {
  testing_support::Random random(1);
  for (int round = 0; round < 20; ++round) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 60; ++i) points.push_back(random.Vector(3));
    const Mesh dut = ConvexHullOf(points);
    for (const Eigen::Vector3d& p : points) EXPECT_TRUE(NearHull(dut, p, 1e-9));
    std::map<std::pair<int, int>, int> edges;
    for (const auto& t : dut.triangles) {
      for (int i = 0; i < 3; ++i)
        ++edges[{static_cast<int>(t[i]), static_cast<int>(t[(i + 1) % 3])}];
    }
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "an edge without its twin";
    }
    EXPECT_GT(SignedVolume(dut), 0) << "wound inward";
  }
}

TEST(Hull, IsTheSameEachTime) {
  const Mesh a = ConvexHullOf(GridCorners(5)), b = ConvexHullOf(GridCorners(5));
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.vertices, b.vertices);
}

}  // namespace
}  // namespace clearway
