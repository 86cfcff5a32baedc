// Prepared meshes against a look at every triangle, and against FCL.
#include "collision/prepared_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "clearway/geometry/distance.h"
#include "collision/brute_geometry.h"
#include "collision/cube_contact.h"
#include "collision/slow_mesh.h"
#include "collision/test_meshes.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kUnsure_m = 1e-6;

// Where the budget does not reach, other ways lead to the same answers.
struct Effort {
  std::string name;
  MeshBudget budget;
  bool enough;
};

class PreparedMeshTest : public testing::TestWithParam<std::tuple<TestMesh, Effort>> {
 protected:
  static const TestMesh& Test() { return std::get<TestMesh>(GetParam()); }
  static const Effort& Spent() { return std::get<Effort>(GetParam()); }

  // The box's distance from the solid by FCL and the plain winding number; how far off the truth
  // that may be at a surface that just touches it, the caller has to say.
  double BruteDistance(const Eigen::Vector3d& center, const Eigen::Matrix3d& R_B_G,
                       const Eigen::Vector3d& half_m) const {
    const Shape shape = TriangleMesh{Test().regular};
    const RobotBody body{oracle_, Eigen::Isometry3d::Identity(), &shape, 0};
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = R_B_G.transpose();
    pose.translation() = center;
    return Distance(body, GeometryOf(Box{2 * half_m}), pose);
  }

  // Made once for all tests of a mesh, as that is slow with sanitizers.
  static const PreparedMesh& Prepared() {
    static std::map<std::string, PreparedMesh> prepared;
    return prepared.try_emplace(Test().name + Spent().name, Test().mesh, Spent().budget)
        .first->second;
  }

  const PreparedMesh& dut_ = Prepared();
  const FclGeometry oracle_ = GeometryOf(TriangleMesh{Test().regular});
};

TEST_P(PreparedMeshTest, HoldsThePointsThatTheMeshWindsRound) {
  Random random(1);
  const Shape shape = TriangleMesh{Test().mesh};
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d p = PointNear(Test(), random);
    if (SlowSurfaceDistance(*Test().mesh, p) < kUnsure_m) continue;
    EXPECT_EQ(dut_.Contains(p), Contains(shape, p)) << p.transpose();
  }
}

TEST_P(PreparedMeshTest, DistancesOfPointsAreThoseOfTheNearestTriangle) {
  Random random(2);
  const Shape shape = TriangleMesh{Test().regular};
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = PointNear(Test(), random);
    const double surface_m = SlowSurfaceDistance(*Test().regular, p);
    const double expected_m = Contains(shape, p) ? 0 : surface_m;
    if (surface_m < kUnsure_m) continue;
    EXPECT_NEAR(dut_.DistanceTo(p, kFar), expected_m, 1e-8);
    const double limit_m = random.Uniform(0, Test().size_m);
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
    for (const Eigen::Vector3d& corner : Test().mesh->vertices) expected.Extend(R_F_G * corner);
    const Aabb found = dut_.BoxTurned(R_F_G);
    EXPECT_LT((found.min - expected.min).norm() + (found.max - expected.max).norm(), 1e-12);
  }
}

TEST_P(PreparedMeshTest, TheSideOfABallIsThatOfAllItsPoints) {
  Random random(7);
  const Shape shape = TriangleMesh{Test().mesh};
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = PointNear(Test(), random);
    const double surface_m = SlowSurfaceDistance(*Test().mesh, p);
    const double radius_m = random.Uniform(0, 2) * surface_m;
    const std::optional<bool> side = dut_.SideOf(p, radius_m);
    if (dut_.closed() && std::abs(surface_m - radius_m) > kUnsure_m) {
      EXPECT_EQ(side.has_value(), radius_m < surface_m) << p.transpose();
    }
    for (const double part : {0.0, 0.5, 0.999}) {
      const Eigen::Vector3d other = p + part * radius_m * random.UnitVector();
      EXPECT_EQ(Contains(shape, other), side.value_or(Contains(shape, other))) << p.transpose();
    }
  }
}

TEST_P(PreparedMeshTest, WhatIsCertainRoundAPointIsTrue) {
  Random random(3);
  const Shape shape = TriangleMesh{Test().mesh};
  int certain = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d p = PointNear(Test(), random);
    const double surface_m = SlowSurfaceDistance(*Test().mesh, p);
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
  EXPECT_GT(certain, Spent().enough ? 300 : 0);
}

TEST_P(PreparedMeshTest, DistancesOfBoxesAreThoseOfFcl) {
  Random random(4);
  int touching = 0, apart = 0;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d center = PointNear(Test(), random);
    const Eigen::Matrix3d R_B_G = random.AnyPose(1).rotation.toRotationMatrix();
    const Eigen::Vector3d half_m =
        Test().size_m * Eigen::Vector3d(random.Uniform(0.02, 0.3), random.Uniform(0.02, 0.3),
                                        random.Uniform(0.02, 0.3));
    const auto grown = [&](double by_m) { return (half_m.array() + by_m).matrix().eval(); };
    const double exact_m = BruteDistance(center, R_B_G, half_m);
    const double limit_m = i % 2 == 0 ? 0 : random.Uniform(0, Test().size_m);
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
  const Shape shape = TriangleMesh{Test().mesh};
  const ShapeGeometry geometry(shape, Reuse::kManyQueries, Spent().budget);
  int no = 0, yes = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pose T_F_G = random.AnyPose(0.3 * Test().size_m), T_G_F = Inverse(T_F_G);
    const PlacedShape placed(geometry, T_F_G);
    const double margin_m = i % 2 == 0 ? 0 : random.Uniform(0, 0.3 * Test().size_m);
    const CubeContact dut(placed, margin_m);
    const Eigen::Vector3d center = PointNear(Test(), random);
    const double half_m = Test().size_m * random.Uniform(0.02, 0.4);
    const CubeContact::Answer answer = dut.Of(center, half_m);
    const double exact_m = BruteDistance(T_G_F * center, T_F_G.rotation.toRotationMatrix(),
                                         Eigen::Vector3d::Constant(half_m));
    const auto [least_m, most_m] = dut.DistanceTo(center, half_m);
    EXPECT_LE(least_m, exact_m + kUnsure_m);
    EXPECT_GE(most_m, exact_m - kUnsure_m);
    if (answer == CubeContact::Answer::kOpen) continue;
    if (answer == CubeContact::Answer::kNo) {
      EXPECT_GT(exact_m, margin_m - kUnsure_m);
      EXPECT_FALSE(Contains(shape, T_G_F * (center + random.Vector(half_m)))) << "a part of it";
      ++no;
    } else {
      EXPECT_LE(exact_m, margin_m + kUnsure_m);
      ++yes;
    }
  }
  EXPECT_GT(no, Spent().enough ? 100 : 0);
  EXPECT_GT(yes, Spent().enough ? 20 : -1);
}

// The second is spent in the middle of things.
std::vector<Effort> Efforts() {
  return {
      {"", {}, true}, {" in haste", {3000, 30'000, 3000}, false}, {" at once", {0, 0, 0}, false}};
}

INSTANTIATE_TEST_SUITE_P(AllMeshes, PreparedMeshTest,
                         testing::Combine(testing::ValuesIn(TestMeshes()),
                                          testing::ValuesIn(Efforts())),
                         [](const auto& test) {
                           std::string name = std::get<TestMesh>(test.param).name +
                                              std::get<Effort>(test.param).name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace clearway
