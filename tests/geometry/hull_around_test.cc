// Polytopes around shapes: they hold all of them, and little more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "clearway/geometry/hull.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

// Every corner of the hull is within `slack_m` of the shape, and all of the shape in the hull.
void ExpectAround(const Shape& shape, double slack_m,
                  const std::function<double(const Eigen::Vector3d&)>& distance_m) {
  const Mesh dut = HullAround(shape);
  EXPECT_TRUE(Validate("dut", ConvexPolytope{std::make_shared<const Mesh>(dut)}).ok());
  for (const Eigen::Vector3d& vertex : dut.vertices) EXPECT_LE(distance_m(vertex), slack_m);
  Random random(1);
  const Aabb box = BoundingBox(shape);
  int inside = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d p = box.Center() + 0.5 * random.Vector(1).cwiseProduct(box.Size());
    if (!Contains(shape, p)) continue;
    ++inside;
    EXPECT_TRUE(NearHull(dut, p, 0)) << p.transpose();
  }
  EXPECT_GT(inside, 5'000);
}

TEST(HullAround, ASphere) {
  ExpectAround(Sphere{2}, 0.02, [](const Eigen::Vector3d& p) { return p.norm() - 2; });
}

TEST(HullAround, ACapsule) {
  ExpectAround(Capsule{0.5, 3}, 0.005, [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d nearest(0, 0, std::clamp(p.z(), -1.5, 1.5));
    return (p - nearest).norm() - 0.5;
  });
}

TEST(HullAround, ACylinder) {
  ExpectAround(Cylinder{0.5, 1.8}, 0.005, [](const Eigen::Vector3d& p) {
    return std::max(std::hypot(p.x(), p.y()) - 0.5, std::abs(p.z()) - 0.9);
  });
}

TEST(HullAround, ABox) {
  ExpectAround(Box{{1, 2, 3}}, 0, [](const Eigen::Vector3d& p) {
    return (p.cwiseAbs() - Eigen::Vector3d(0.5, 1, 1.5)).maxCoeff();
  });
  EXPECT_EQ(HullAround(Box{{1, 2, 3}}).vertices.size(), 8u);
}

// Directions in which the sampled points of a box hardly get to the surface.
TEST(HullAround, HoldsTheSurfaceOfRoundShapes) {
  Random random(2);
  const Mesh sphere = HullAround(Sphere{1}), capsule = HullAround(Capsule{1, 2}),
             cylinder = HullAround(Cylinder{1, 2});
  for (int i = 0; i < 5'000; ++i) {
    const Eigen::Vector3d n = random.UnitVector();
    EXPECT_TRUE(NearHull(sphere, n, 0));
    EXPECT_TRUE(NearHull(capsule, n + Eigen::Vector3d(0, 0, n.z() < 0 ? -1 : 1), 0));
    Eigen::Vector3d side(n.x(), n.y(), 0);
    side.normalize();
    EXPECT_TRUE(NearHull(cylinder, side + Eigen::Vector3d(0, 0, n.z()), 0));
    EXPECT_TRUE(NearHull(capsule, side + Eigen::Vector3d(0, 0, n.z()), 0));
  }
}

TEST(HullAround, AMeshIsItsVerticesHull) {
  auto mesh = std::make_shared<Mesh>(HullAround(Cylinder{1, 1}));
  EXPECT_EQ(HullAround(ConvexPolytope{mesh}).vertices, mesh->vertices);
  EXPECT_EQ(HullAround(TriangleMesh{mesh}).vertices, mesh->vertices);
}

TEST(Shape, IsComparedByValue) {
  const auto mesh = std::make_shared<const Mesh>(HullAround(Box{{1, 1, 1}}));
  const auto twin = std::make_shared<const Mesh>(*mesh);
  EXPECT_EQ(Shape(ConvexPolytope{mesh}), Shape(ConvexPolytope{twin}));
  EXPECT_NE(Shape(ConvexPolytope{mesh}), Shape(TriangleMesh{mesh}));
  EXPECT_NE(Shape(ConvexPolytope{mesh}), Shape(ConvexPolytope{nullptr}));
  EXPECT_EQ(Shape(Box{{1, 2, 3}}), Shape(Box{{1, 2, 3}}));
  EXPECT_NE(Shape(Cylinder{1, 2}), Shape(Capsule{1, 2}));
}

}  // namespace
}  // namespace clearway
