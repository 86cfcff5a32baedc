#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "sim/mesh_bvh.h"
#include "sim/meshes.h"
#include "sim/ray_shape.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// A bumpy closed surface of 2 * n * n triangles: enough for a deep tree.
std::shared_ptr<const Mesh> BumpyRing(int n) {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / n;
      const double r = 0.5 + 0.1 * std::sin(3 * u + 2 * v);
      mesh->vertices.emplace_back((2 + r * std::cos(v)) * std::cos(u),
                                  (2 + r * std::cos(v)) * std::sin(u), r * std::sin(v));
      const auto at = [n](int a, int b) { return static_cast<std::uint32_t>(a % n * n + b % n); };
      mesh->triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh->triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

TEST(MeshBvhTest, EmptyIsNeverHit) {
  const MeshBvh dut(std::make_shared<const Mesh>());
  EXPECT_EQ(dut.RayDistance({0, 0, 0}, {1, 0, 0}), kNoHit);
}

TEST(MeshBvhTest, HitsWhatTryingEveryTriangleHits) {
  const auto mesh = BumpyRing(24);
  const MeshBvh dut(mesh);
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 3'000; ++i) {
    const Eigen::Vector3d origin = random.Vector(4);
    const Eigen::Vector3d direction = (random.Vector(2) - origin).normalized();
    double expected = kNoHit;
    for (const auto& [a, b, c] : mesh->triangles) {
      expected = std::min(expected, RayDistanceToTriangle(mesh->vertices[a], mesh->vertices[b],
                                                          mesh->vertices[c], origin, direction));
    }
    EXPECT_EQ(dut.RayDistance(origin, direction), expected);
    hits += expected < kNoHit;
  }
  EXPECT_GT(hits, 500);
}

TEST(MeshBvhTest, RaysThroughSharedEdgesDoNotSlipThrough) {
  const auto box = Extruded({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 2);
  const MeshBvh dut(box);
  // The diagonals of the faces, from outside, along the axes.
  for (double s = -0.9; s <= 0.9; s += 0.05) {
    EXPECT_NEAR(dut.RayDistance({s, -3, s}, {0, 1, 0}), 2, 1e-12);
    EXPECT_NEAR(dut.RayDistance({-3, s, s}, {1, 0, 0}), 2, 1e-12);
    EXPECT_NEAR(dut.RayDistance({s, s, 3}, {0, 0, -1}), 2, 1e-12);
  }
}

TEST(ExtrudedTest, IsClosedAndTurnedOutward) {
  const auto dut =
      Extruded({{0, 0}, {0, 0.3}, {-0.3, 0.3}, {-0.3, -0.3}, {0.3, -0.3}, {0.3, 0}}, 0.4);
  // By the divergence theorem the signed volume is that of an L of three squares, positive if the
  // triangles face outward; each edge is used once in each direction.
  double volume = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : dut->triangles) {
    volume += dut->vertices[a].dot(dut->vertices[b].cross(dut->vertices[c])) / 6;
    ++edges[{a, b}], ++edges[{b, c}], ++edges[{c, a}];
  }
  EXPECT_NEAR(volume, 3 * 0.3 * 0.3 * 0.4, 1e-12);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(ExtrudedTest, ContainsItsProfile) {
  const TriangleMesh dut{
      Extruded({{0, 0}, {0, 0.3}, {-0.3, 0.3}, {-0.3, -0.3}, {0.3, -0.3}, {0.3, 0}}, 0.4)};
  EXPECT_TRUE(Contains(dut, {-0.1, 0.1, 0.1}));
  EXPECT_TRUE(Contains(dut, {0.1, -0.1, -0.1}));
  EXPECT_FALSE(Contains(dut, {0.1, 0, 0.1}));  // the open corner of the L
  EXPECT_FALSE(Contains(dut, {-0.1, 0.21, 0.1}));
}

}  // namespace
}  // namespace clearway
