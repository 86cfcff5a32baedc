// The quick answers about cubes against the exact distance, and contact with a map against a look
// at every voxel.
#include "collision/voxel_contact.h"

#include <gtest/gtest.h>

#include <limits>

#include "clearway/geometry/hull.h"
#include "collision/cube_bounds.h"
#include "collision/cube_contact.h"
#include "collision/test_meshes.h"
#include "collision/voxel_distance.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

std::vector<Shape> Shapes() {
  return {Sphere{0.3}, Sphere{0.01}, Box{{0.9, 0.3, 0.05}}, Capsule{0.1, 0.8}, Cylinder{0.3, 0.5}};
}

TEST(CubeContact, CertainAnswersAreRight) {
  Random random(1);
  for (const Shape& shape : Shapes()) {
    const ShapeGeometry geometry(shape);
    int open = 0, no = 0, yes = 0;
    for (int i = 0; i < 20'000; ++i) {
      const PlacedShape placed(geometry, random.AnyPose(0.3));
      const double margin_m = i % 2 == 0 ? 0 : random.Uniform(0, 0.3);
      const CubeContact dut(placed, margin_m);
      const Eigen::Vector3d center = random.Vector(1);
      const double half_m = random.Uniform(0.01, 0.4);
      const Aabb cube{center.array() - half_m, center.array() + half_m};
      const bool touches = placed.DistanceTo(cube, margin_m) <= margin_m;
      const CubeContact::Answer answer = dut.Of(center, half_m);
      EXPECT_FALSE(answer == CubeContact::Answer::kNo && touches);
      EXPECT_FALSE(answer == CubeContact::Answer::kYes && !touches);
      no += answer == CubeContact::Answer::kNo;
      yes += answer == CubeContact::Answer::kYes;
      open += answer == CubeContact::Answer::kOpen;
    }
    EXPECT_GT(no, 500);
    EXPECT_GT(yes, 500);
    EXPECT_LT(open, 1000);
  }
}

TEST(CubeContact, BoundsHoldTheDistance) {
  Random random(3);
  for (const Shape& shape : Shapes()) {
    const ShapeGeometry geometry(shape);
    int tight = 0;
    for (int i = 0; i < 20'000; ++i) {
      const PlacedShape placed(geometry, random.AnyPose(0.3));
      const Eigen::Vector3d center = random.Vector(1.5);
      const double half_m = random.Uniform(0.01, 0.2);
      const auto [least_m, most_m] = CubeContact(placed, 0.1).DistanceTo(center, half_m);
      const double exact_m = placed.DistanceTo({center.array() - half_m, center.array() + half_m},
                                               std::numeric_limits<double>::infinity());
      constexpr double kIterated_m = 1e-6;  // what FCL's distances of boxes are good for
      ASSERT_LE(least_m, exact_m + kIterated_m);
      ASSERT_GE(most_m, exact_m - kIterated_m);
      tight += most_m - least_m < half_m;
    }
    EXPECT_GT(tight, 18'000);
  }
}

class VoxelContactTest : public testing::Test {
 protected:
  VoxelContactTest() {
    for (int i = 0; i < 60'000; ++i) {
      const VoxelKey key = map_.grid().KeyOf(random_.Vector(1.6));
      map_.Set(key, static_cast<LogOdds>(random_.Integer(0, 60) == 0 ? 100 : -100));
    }
  }
  void ExpectAnswersOfEveryVoxel(const std::vector<Shape>& shapes, int poses_of_each);
  // Whether a voxel of the state within 2 m lies within the margin.
  bool Touches(const PlacedShape& shape, VoxelState state, double margin_m,
               const std::vector<Aabb>& left_out) const {
    const VoxelGrid& grid = map_.grid();
    for (VoxelKey key{-20, 0, 0}; key.x < 20; ++key.x) {
      for (key.y = -20; key.y < 20; ++key.y) {
        for (key.z = -20; key.z < 20; ++key.z) {
          if (map_.State(key) != state || InOneOf(left_out, grid.CenterOf(key))) continue;
          if (shape.DistanceTo(grid.BoxOf(key), margin_m) <= margin_m) return true;
        }
      }
    }
    return false;
  }
  // Of the nearest occupied voxel within 2 m.
  double Distance(const PlacedShape& shape, double up_to_m) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    map_.blocks().ForEach([&](BlockKey key, const VoxelBlock& block) {
      block.occupied.ForEach([&](int i) {
        nearest_m =
            std::min(nearest_m, shape.DistanceTo(map_.grid().BoxOf(VoxelAt(key, i)), up_to_m));
      });
    });
    return nearest_m;
  }
  // Meshes and hulls too.
  static std::vector<Shape> AllShapes() {
    std::vector<Shape> shapes = Shapes();
    for (const TestMesh& test : TestMeshes()) {
      if (test.size_m > 1) continue;
      shapes.push_back(TriangleMesh{test.mesh});
      Mesh hull = ConvexHullOf(test.mesh->vertices);
      if (hull.triangles.empty()) continue;
      shapes.push_back(ConvexPolytope{std::make_shared<const Mesh>(std::move(hull))});
    }
    return shapes;
  }

  Random random_{2};
  VoxelMap map_{0.1};
};

void VoxelContactTest::ExpectAnswersOfEveryVoxel(const std::vector<Shape>& shapes,
                                                 int poses_of_each) {
  std::array<int, 2> occupied{}, unobserved{};
  for (const Shape& shape : shapes) {
    const ShapeGeometry geometry(shape, Reuse::kManyQueries);
    const int poses = geometry.prepared() == nullptr ? poses_of_each : poses_of_each / 5;
    for (int i = 0; i < poses; ++i) {
      const PlacedShape placed(geometry, random_.AnyPose(0.8));
      const double margin_m = i % 3 == 0 ? random_.Uniform(0, 0.1) : 0;
      const bool touches = TouchesOccupied(map_, placed, margin_m);
      EXPECT_EQ(touches, Touches(placed, VoxelState::kOccupied, margin_m, {}));
      ++occupied[touches];
      const Eigen::Vector3d corner = random_.Vector(1);
      std::vector<Aabb> known_free;
      if (i % 2 == 0) known_free.push_back({corner.array() - 0.7, corner.array() + 0.7});
      const bool unknown =
          TouchesUnobserved(map_, placed, known_free, margin_m, [] { return false; });
      EXPECT_EQ(unknown, Touches(placed, VoxelState::kUnknown, margin_m, known_free));
      ++unobserved[unknown];
    }
  }
  for (const int count : {occupied[0], occupied[1], unobserved[0], unobserved[1]}) {
    EXPECT_GT(count, 10);
  }
}

TEST_F(VoxelContactTest, AgreesWithALookAtEveryVoxel) {
  ExpectAnswersOfEveryVoxel(AllShapes(), 60);
}

// Thin shapes among scattered voxels: their boxes hold most of a block, of which they touch little.
TEST_F(VoxelContactTest, AgreesForNeedlesInDust) {
  VoxelMap dust(0.1);
  for (VoxelKey key{-20, 0, 0}; key.x < 20; ++key.x) {
    for (key.y = -20; key.y < 20; ++key.y) {
      for (key.z = -20; key.z < 20; ++key.z) {
        if (random_.Integer(0, 100) == 0) continue;
        dust.Set(key, random_.Integer(0, 14) == 0 ? LogOdds{100} : LogOdds{-100});
      }
    }
  }
  map_ = dust;
  ExpectAnswersOfEveryVoxel({Box{{2, 0.02, 0.02}}, Capsule{0.01, 2}, Cylinder{0.01, 2}}, 400);
}

TEST_F(VoxelContactTest, DistanceIsThatOfTheNearestVoxel) {
  int near = 0, beyond = 0;
  for (const Shape& shape : AllShapes()) {
    for (const Reuse reuse : {Reuse::kFewQueries, Reuse::kManyQueries}) {
      const ShapeGeometry geometry(shape, reuse);
      const int poses = geometry.prepared() == nullptr ? 40 : 12;
      for (int i = 0; i < poses; ++i) {
        const PlacedShape placed(geometry, random_.AnyPose(i % 2 == 0 ? 1 : 4));
        const double up_to_m = random_.Uniform(0, 3);
        const double expected_m = Distance(placed, up_to_m);
        const double distance_m = DistanceToOccupied(map_, placed, up_to_m);
        if (expected_m <= up_to_m) {
          EXPECT_NEAR(distance_m, expected_m, 1e-6);
          near += expected_m > 0;
        } else {
          EXPECT_GT(distance_m, up_to_m);
          ++beyond;
        }
      }
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(beyond, 20);
}

// More of them than are bounded at once.
TEST(VoxelDistance, IsFoundAmongManyBlocks) {
  Random random(4);
  VoxelMap map(0.1);
  std::vector<VoxelKey> keys;
  for (std::int32_t x = -5; x < 5; ++x) {
    for (std::int32_t y = -5; y < 5; ++y) {
      for (std::int32_t z = -5; z < 5; ++z) {
        keys.push_back(VoxelAt({2 * x, 2 * y, 2 * z}, random.Integer(0, kVoxelsPerBlock - 1)));
        map.Set(keys.back(), 100);
      }
    }
  }
  ASSERT_GT(keys.size(), BoundedCubes::kMost);
  for (const Shape& shape : Shapes()) {
    const ShapeGeometry geometry(shape);
    for (int i = 0; i < 20; ++i) {
      const PlacedShape placed(geometry, random.AnyPose(8));
      double expected_m = std::numeric_limits<double>::infinity();
      for (const VoxelKey& key : keys) {
        expected_m = std::min(expected_m, placed.DistanceTo(map.grid().BoxOf(key), expected_m));
      }
      EXPECT_NEAR(DistanceToOccupied(map, placed, 100), expected_m, 1e-6);
    }
  }
}

}  // namespace
}  // namespace clearway
