// Bounds of many cubes at a time against those of one, and against the exact distance.
#include "collision/cube_bounds.h"

#include <gtest/gtest.h>

#include "collision/test_meshes.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kSame_m = 1e-9;
constexpr double kIterated_m = 1e-6;  // what FCL's distances of boxes are good for

std::vector<Shape> Shapes() {
  const auto ball = std::make_shared<const Mesh>(
      BallMesh(6, 8, [](const Eigen::Vector3d& direction) { return 0.4 + 0.1 * direction.x(); }));
  return {Sphere{0.3}, Box{{0.9, 0.3, 0.05}}, Capsule{0.1, 0.8}, Cylinder{0.3, 0.5},
          TriangleMesh{ball}};
}

// Some centres lie in the shape, at its middle or on its axis, where nothing tells a direction.
Eigen::Vector3d AnyCenter(Random& random, const Pose& T_F_G, int i) {
  if (i % 50 == 0) return T_F_G.translation;
  if (i % 50 == 1) return T_F_G * Eigen::Vector3d(0, 0, random.Uniform(-1, 1));
  return random.Vector(1.5);
}

TEST(CubeBounds, HoldTheDistanceAndAreThoseOfOneCube) {
  Random random(7);
  for (const Shape& shape : Shapes()) {
    const ShapeGeometry geometry(shape);
    for (int round = 0; round < 60; ++round) {
      const Pose T_F_G = random.AnyPose(0.3);
      const PlacedShape placed(geometry, T_F_G);
      const double half_m = random.Uniform(0.01, 0.4);
      BoundedCubes cubes;
      const std::size_t count = round == 0 ? BoundedCubes::kMost : round;
      std::vector<Eigen::Vector3d> centers;
      while (cubes.count < count) {
        centers.push_back(AnyCenter(random, T_F_G, static_cast<int>(cubes.count)));
        cubes.Add(centers.back());
      }
      CubeBounds(placed).Bound(half_m, cubes);
      for (std::size_t i = 0; i < count; ++i) {
        const auto [least_m, most_m] = CubeContact(placed, 0).DistanceTo(centers[i], half_m);
        EXPECT_NEAR(cubes.least_m[i], least_m, kSame_m);
        EXPECT_NEAR(cubes.most_m[i], most_m, kSame_m);
        const double exact_m = placed.DistanceTo(
            {centers[i].array() - half_m, centers[i].array() + half_m}, cubes.most_m[i]);
        EXPECT_LE(cubes.least_m[i], exact_m + kIterated_m);
        EXPECT_GE(cubes.most_m[i], exact_m - kIterated_m);
      }
    }
  }
}

}  // namespace
}  // namespace clearway
