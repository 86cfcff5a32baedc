#include "collision/mesh_budget.h"

#include <gtest/gtest.h>

#include "collision/test_meshes.h"
#include "collision/test_world.h"

namespace clearway {
namespace {

Shape BallOf(int rings) {
  const auto radius_m = [](const Eigen::Vector3d&) { return 0.3; };
  return TriangleMesh{std::make_shared<const Mesh>(BallMesh(rings, 2 * rings, radius_m))};
}

Robot Repeated(const Shape& shape, std::size_t times) {
  Robot robot = Robot::SingleShape("r", shape);
  robot.links[0].shapes.assign(times, robot.links[0].shapes[0]);
  return robot;
}

TEST(MeshBudgetTest, Empty) { EXPECT_EQ(BudgetShares(Robot{}).Next(Sphere{1}).cells, 1 << 15); }

TEST(MeshBudgetTest, OneMeshHasAllThatAMeshMayHave) {
  const Shape mesh = BallOf(20);
  const MeshBudget dut = BudgetShares(Repeated(mesh, 1)).Next(mesh), most;
  EXPECT_EQ(dut.cells, most.cells);
  EXPECT_EQ(dut.visits, most.visits);
  EXPECT_EQ(dut.angles, most.angles);
  EXPECT_EQ(dut.hull_corners, most.hull_corners);
}

TEST(MeshBudgetTest, ManyMeshesShareWhatARobotMayHave) {
  const Shape mesh = BallOf(20);
  const Robot robot = Repeated(mesh, 900);
  BudgetShares shares(robot);
  MeshBudget sum{0, 0, 0, 0};
  for (const LinkShape& part : robot.links[0].shapes) {
    const MeshBudget dut = shares.Next(part.shape);
    sum.cells += dut.cells;
    sum.visits += dut.visits;
    sum.angles += dut.angles;
  }
  EXPECT_NEAR(sum.cells, 1 << 20, 1);
  EXPECT_NEAR(static_cast<double>(sum.visits), 7e7, 1000);
  EXPECT_NEAR(static_cast<double>(sum.angles), 5e7, 1000);
}

TEST(MeshBudgetTest, SmallMeshesGetSmallerParts) {
  Robot robot = Repeated(BallOf(20), 100);
  robot.links[0].shapes.push_back({TriangleMesh{CubeMesh(1)}, Pose{}});
  BudgetShares shares(robot);
  EXPECT_GT(shares.Next(robot.links[0].shapes.front().shape).cells,
            10 * shares.Next(robot.links[0].shapes.back().shape).cells);
}

TEST(MeshBudgetTest, HullsOfManyCornersAreNotAllPrepared) {
  Mesh rim;
  rim.vertices.resize(9000);
  rim.triangles = {{0, 1, 2}};
  const Shape hull = ConvexPolytope{std::make_shared<const Mesh>(rim)};
  BudgetShares shares(Repeated(hull, 2));
  EXPECT_GE(shares.Next(hull).hull_corners, 9000u);
  EXPECT_EQ(shares.Next(hull).hull_corners, 0u);
}

}  // namespace
}  // namespace clearway
