#include "clearway/geometry/distance.h"

#include <gtest/gtest.h>

#include <memory>

#include "clearway/geometry/hull.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

TEST(SurfaceDistance, IsTheSameFromBothSides) {
  const double half_m = 0.5;
  EXPECT_DOUBLE_EQ(SurfaceDistance({0.1, 0, 0}, Sphere{half_m}), 0.4);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0, 0, 2}, Sphere{half_m}), 1.5);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0, 0.4, 0}, Box{{1, 2, 1}}), 0.5);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0, 0.8, 0}, Box{{1, 2, 1}}), 0.2);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0.5 + 3, 1 + 4, 0}, Box{{1, 2, 1}}), 5);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0, 0.1, 0.3}, Capsule{half_m, 1}), 0.4);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0, 0, 3}, Capsule{half_m, 1}), 2);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0, 0, 0.9}, Cylinder{half_m, 2}), 0.1);
  EXPECT_DOUBLE_EQ(SurfaceDistance({0, 0.6, 0}, Cylinder{half_m, 2}), 0.1);
  EXPECT_NEAR(SurfaceDistance({half_m, 0, 0}, Cylinder{half_m, 2}), 0, 1e-15);
}

TEST(SurfaceDistance, OfAMeshIsThatOfTheBoxThatItIs) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Box box{random.Vector(1).cwiseAbs().array() + 0.2};
    const auto mesh = std::make_shared<const Mesh>(HullAround(box));
    const Eigen::Vector3d p = random.Vector(1.5);
    const double expected_m = SurfaceDistance(p, box);
    EXPECT_NEAR(SurfaceDistance(p, TriangleMesh{mesh}), expected_m, 1e-12);
    EXPECT_NEAR(SurfaceDistance(p, ConvexPolytope{mesh}), expected_m, 1e-12);
  }
}

}  // namespace
}  // namespace clearway
