#include "clearway/geometry/shape.h"

#include <gtest/gtest.h>

#include "clearway/geometry/hull.h"
#include "support/random.h"

namespace clearway {
namespace {

std::shared_ptr<const Mesh> BoxMesh(const Eigen::Vector3d& size_m) {
  std::vector<Eigen::Vector3d> corners;
  for (int c = 0; c < 8; ++c) {
    corners.push_back(
        0.5 * size_m.cwiseProduct(Eigen::Vector3d(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1)));
  }
  return std::make_shared<const Mesh>(ConvexHullOf(corners));
}

TEST(Shape, EmptyHullContainsNothing) {
  EXPECT_FALSE(Contains(ConvexPolytope{std::make_shared<const Mesh>()}, Eigen::Vector3d::Zero()));
  EXPECT_TRUE(BoundingBox(ConvexPolytope{std::make_shared<const Mesh>()}).Empty());
}

TEST(Shape, BoundingBoxes) {
  EXPECT_EQ(BoundingBox(Sphere{2}), (Aabb{{-2, -2, -2}, {2, 2, 2}}));
  EXPECT_EQ(BoundingBox(Box{{2, 4, 6}}), (Aabb{{-1, -2, -3}, {1, 2, 3}}));
  EXPECT_EQ(BoundingBox(Capsule{1, 4}), (Aabb{{-1, -1, -3}, {1, 1, 3}}));
  EXPECT_EQ(BoundingBox(Cylinder{1, 4}), (Aabb{{-1, -1, -2}, {1, 1, 2}}));
  EXPECT_EQ(BoundingBox(TriangleMesh{BoxMesh({2, 4, 6})}), (Aabb{{-1, -2, -3}, {1, 2, 3}}));
}

TEST(Shape, BoxHullAndClosedMeshContainTheSamePoints) {
  const Eigen::Vector3d size_m(1.0, 2.0, 0.5);
  const auto mesh = BoxMesh(size_m);
  testing_support::Random random(1);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = random.Vector(1.2);
    const bool expected = Contains(Box{size_m}, p);
    EXPECT_EQ(Contains(ConvexPolytope{mesh}, p), expected);
    EXPECT_EQ(Contains(TriangleMesh{mesh}, p), expected);
    inside += expected;
  }
  EXPECT_GT(inside, 50);
}

TEST(Shape, CapsuleIsACylinderWithTwoBalls) {
  testing_support::Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = random.Vector(1.2);
    const bool expected = Contains(Cylinder{0.4, 1.0}, p) ||
                          Contains(Sphere{0.4}, p - Eigen::Vector3d(0, 0, 0.5)) ||
                          Contains(Sphere{0.4}, p + Eigen::Vector3d(0, 0, 0.5));
    EXPECT_EQ(Contains(Capsule{0.4, 1.0}, p), expected) << p.transpose();
  }
}

TEST(Shape, NearHullHoldsAllWithinTheMargin) {
  const auto mesh = BoxMesh({2, 2, 2});
  EXPECT_TRUE(NearHull(*mesh, {1.09, 0, 0}, 0.1));
  EXPECT_FALSE(NearHull(*mesh, {1.11, 0, 0}, 0.1));
}

}  // namespace
}  // namespace clearway
