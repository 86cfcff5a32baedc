// Prepared meshes against a look at every triangle, and against FCL.
#include "collision/prepared_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "collision/brute_geometry.h"
#include "collision/closed_form.h"
#include "collision/cube_contact.h"
#include "collision/test_meshes.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kUnsure_m = 1e-6;

double BruteSurfaceDistance(const Mesh& mesh, const Eigen::Vector3d& p) {
  double nearest_m = kFar;
  for (const auto& [a, b, c] : mesh.triangles) {
    nearest_m = std::min(
        nearest_m, PointTriangleDistance(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
  }
  return nearest_m;
}

// A point near the mesh, at times far off.
Eigen::Vector3d PointNear(const TestMesh& test, Random& random) {
  return random.Vector(test.size_m * (random.Integer(0, 5) == 0 ? 4 : 1.3));
}

class PreparedMeshTest : public testing::TestWithParam<TestMesh> {
 protected:
  // The box's distance from the solid by FCL and the plain winding number; how far off the truth
  // that may be at a surface that just touches it, the caller has to say.
  double BruteDistance(const Eigen::Vector3d& center, const Eigen::Matrix3d& R_B_G,
                       const Eigen::Vector3d& half_m) const {
    const Shape shape = TriangleMesh{GetParam().regular};
    const RobotBody body{oracle_, Eigen::Isometry3d::Identity(), &shape, 0};
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = R_B_G.transpose();
    pose.translation() = center;
    return Distance(body, GeometryOf(Box{2 * half_m}), pose);
  }

  // Made once for all tests of a mesh, as that is slow with sanitizers.
  static const PreparedMesh& Prepared(const TestMesh& test) {
    static std::map<std::string, PreparedMesh> prepared;
    return prepared.try_emplace(test.name, test.mesh).first->second;
  }

  const PreparedMesh& dut_ = Prepared(GetParam());
  const FclGeometry oracle_ = GeometryOf(TriangleMesh{GetParam().regular});
};

TEST_P(PreparedMeshTest, HoldsThePointsThatTheMeshWindsRound) {
  Random random(1);
  const Shape shape = TriangleMesh{GetParam().mesh};
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d p = PointNear(GetParam(), random);
    if (BruteSurfaceDistance(*GetParam().mesh, p) < kUnsure_m) continue;
    EXPECT_EQ(dut_.Contains(p), Contains(shape, p)) << p.transpose();
  }
}

TEST_P(PreparedMeshTest, DistancesOfPointsAreThoseOfTheNearestTriangle) {
  Random random(2);
  const Shape shape = TriangleMesh{GetParam().regular};
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = PointNear(GetParam(), random);
    const double surface_m = BruteSurfaceDistance(*GetParam().regular, p);
    const double expected_m = Contains(shape, p) ? 0 : surface_m;
    if (surface_m < kUnsure_m) continue;
    EXPECT_NEAR(dut_.DistanceTo(p, kFar), expected_m, 1e-8);
    const double limit_m = random.Uniform(0, GetParam().size_m);
    const double found_m = dut_.DistanceTo(p, limit_m);
    EXPECT_EQ(found_m > limit_m, expected_m > limit_m);
    if (expected_m <= limit_m) {
      EXPECT_NEAR(found_m, expected_m, 1e-8);
    }
  }
}

TEST_P(PreparedMeshTest, BoxesAroundItHoldItsCornersAndNoMore) {
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    Eigen::Matrix3d R_F_G = random.AnyPose(1).rotation.toRotationMatrix();
    if (i == 0) R_F_G.setIdentity();
    Aabb expected;
    for (const Eigen::Vector3d& corner : GetParam().mesh->vertices) expected.Extend(R_F_G * corner);
    const Aabb found = dut_.BoxTurned(R_F_G);
    EXPECT_LT((found.min - expected.min).norm() + (found.max - expected.max).norm(), 1e-12);
  }
}

TEST_P(PreparedMeshTest, WhatIsCertainRoundAPointIsTrue) {
  Random random(3);
  const Shape shape = TriangleMesh{GetParam().mesh};
  int certain = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d p = PointNear(GetParam(), random);
    const double surface_m = BruteSurfaceDistance(*GetParam().mesh, p);
    const DistanceGrid::Surroundings around = dut_.Around(p);
    EXPECT_LE(around.near_m, surface_m + 1e-9);
    EXPECT_GE(around.far_m, surface_m - 1e-9);
    if (around.same_m <= 1e-9) continue;
    ++certain;
    for (const double part : {0.0, 0.5, 0.999}) {
      const Eigen::Vector3d other = p + part * around.same_m * random.UnitVector();
      EXPECT_EQ(Contains(shape, other), around.inside) << p.transpose();
    }
  }
  EXPECT_GT(certain, 300);
}

TEST_P(PreparedMeshTest, DistancesOfBoxesAreThoseOfFcl) {
  Random random(4);
  int touching = 0, apart = 0;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d center = PointNear(GetParam(), random);
    const Eigen::Matrix3d R_B_G = random.AnyPose(1).rotation.toRotationMatrix();
    const Eigen::Vector3d half_m =
        GetParam().size_m * Eigen::Vector3d(random.Uniform(0.02, 0.3), random.Uniform(0.02, 0.3),
                                            random.Uniform(0.02, 0.3));
    const auto grown = [&](double by_m) { return (half_m.array() + by_m).matrix().eval(); };
    const double exact_m = BruteDistance(center, R_B_G, half_m);
    const double limit_m = i % 2 == 0 ? 0 : random.Uniform(0, GetParam().size_m);
    const bool surely_near = BruteDistance(center, R_B_G, grown(-kUnsure_m)) <= limit_m;
    const bool surely_far = BruteDistance(center, R_B_G, grown(kUnsure_m)) > limit_m;
    const double found_m = dut_.DistanceTo(OrientedBox(center, R_B_G, half_m), limit_m);
    if (surely_near) {
      EXPECT_NEAR(found_m, exact_m, 1e-7) << i;
    } else if (surely_far) {
      EXPECT_GT(found_m, limit_m) << i;
    }
    EXPECT_NEAR(dut_.DistanceTo(OrientedBox(center, R_B_G, half_m), kFar), exact_m, 1e-7) << i;
    touching += surely_near;
    apart += surely_far;
  }
  EXPECT_GT(touching, 20);
  EXPECT_GT(apart, 20);
}

TEST_P(PreparedMeshTest, CertainAnswersAboutCubesAreRight) {
  Random random(5);
  const ShapeGeometry geometry(TriangleMesh{GetParam().mesh});
  int no = 0, yes = 0;
  for (int i = 0; i < 2000; ++i) {
    const PlacedShape placed(geometry, random.AnyPose(0.3 * GetParam().size_m));
    const double margin_m = i % 2 == 0 ? 0 : random.Uniform(0, 0.3 * GetParam().size_m);
    const CubeContact dut(placed, margin_m);
    const Eigen::Vector3d center = PointNear(GetParam(), random);
    const double half_m = GetParam().size_m * random.Uniform(0.02, 0.4);
    const Aabb cube{center.array() - half_m, center.array() + half_m};
    const double exact_m = placed.DistanceTo(cube, margin_m);
    switch (dut.Of(center, half_m)) {
      case CubeContact::Answer::kNo: {
        EXPECT_GT(exact_m, margin_m);
        const Eigen::Vector3d inside = center + random.Vector(half_m);
        EXPECT_FALSE(placed.Contains(inside)) << "of a part of the cube";
        ++no;
        break;
      }
      case CubeContact::Answer::kYes:
        EXPECT_LE(exact_m, margin_m);
        ++yes;
        break;
      case CubeContact::Answer::kOpen:
        break;
    }
  }
  EXPECT_GT(no, 100);
  EXPECT_GT(yes, 20);
}

INSTANTIATE_TEST_SUITE_P(AllMeshes, PreparedMeshTest, testing::ValuesIn(TestMeshes()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace clearway
