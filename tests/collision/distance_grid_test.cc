// What a grid is certain of, against a look at every triangle.
#include "collision/distance_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "clearway/geometry/distance.h"
#include "collision/slow_mesh.h"
#include "collision/test_meshes.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

struct Effort {
  std::string name;
  MeshBudget budget;
};
std::vector<Effort> Efforts() {
  MeshBudget few_cells, few_visits, few_angles;
  few_cells.cells = 8;
  few_visits.visits = 2000;
  few_angles.angles = 2000;
  return {{"enough", {}},
          {"few cells", few_cells},
          {"few visits", few_visits},
          {"few angles", few_angles}};
}

Aabb BoxOf(const Mesh& mesh) {
  Aabb box;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) box.Extend(mesh.vertices[corner]);
  }
  return box;
}

// Of an open mesh too, by the sum of the angles under which its triangles are seen.
bool Inside(const Mesh& mesh, const Aabb& box, const Eigen::Vector3d& p) {
  double angle = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    angle += SolidAngle(mesh.vertices[a] - p, mesh.vertices[b] - p, mesh.vertices[c] - p);
  }
  return box.Contains(p) && std::abs(angle) > 2 * std::numbers::pi;
}

class DistanceGridTest : public testing::TestWithParam<TestMesh> {
 protected:
  const std::shared_ptr<const Mesh> mesh_ = GetParam().mesh;
  const Aabb box_ = BoxOf(*mesh_);
  const TriangleTree tree_{*mesh_};
  const WindingTree winding_{mesh_, tree_};
};

TEST_P(DistanceGridTest, BoundsTheDistance) {
  for (const Effort& effort : Efforts()) {
    Random random(1);
    const DistanceGrid dut(box_, tree_, winding_, effort.budget);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p = PointNear(GetParam(), random);
      const DistanceGrid::Surroundings around = dut.At(p);
      const double distance_m = SlowSurfaceDistance(*mesh_, p), unsure_m = 1e-12 * (1 + distance_m);
      ASSERT_LE(around.near_m, distance_m + unsure_m) << effort.name;
      ASSERT_GE(around.far_m, distance_m - unsure_m) << effort.name;
    }
  }
}

TEST_P(DistanceGridTest, WhatIsNearerThanThatIsOnTheSameSide) {
  int certain = 0;
  for (const Effort& effort : Efforts()) {
    Random random(2);
    const DistanceGrid dut(box_, tree_, winding_, effort.budget);
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d p = PointNear(GetParam(), random);
      const DistanceGrid::Surroundings around = dut.At(p);
      if (around.same_m <= 1e-9) continue;
      ++certain;
      ASSERT_EQ(Inside(*mesh_, box_, p), around.inside) << effort.name;
      const Eigen::Vector3d q = p + (around.same_m - 1e-9) * random.UnitVector();
      ASSERT_EQ(Inside(*mesh_, box_, q), around.inside) << effort.name;
    }
  }
  EXPECT_GT(certain, 100);
}

TEST_P(DistanceGridTest, MoreCellsAreCertainOfMore) {
  Random random(3);
  MeshBudget few;
  few.cells = 8;
  const DistanceGrid fine(box_, tree_, winding_, {}), coarse(box_, tree_, winding_, few);
  double fine_m = 0, coarse_m = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = random.Vector(GetParam().size_m);
    fine_m += fine.At(p).far_m - fine.At(p).near_m;
    coarse_m += coarse.At(p).far_m - coarse.At(p).near_m;
  }
  if (WantedCells(mesh_->triangles.size()) > 100) {
    EXPECT_LT(fine_m, 0.8 * coarse_m);
  } else {
    EXPECT_LE(fine_m, coarse_m * (1 + 1e-9));
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, DistanceGridTest, testing::ValuesIn(TestMeshes()),
                         [](const auto& each) {
                           std::string name = each.param.name;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

}  // namespace
}  // namespace clearway
