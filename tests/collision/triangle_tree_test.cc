// The tree over a mesh's triangles, and winding numbers against those of all triangles.
#include "collision/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "clearway/geometry/distance.h"
#include "collision/test_meshes.h"
#include "collision/winding_tree.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

TEST(TriangleTreeTest, EveryTriangleIsInOneLeafThatHoldsIt) {
  for (const TestMesh& test : TestMeshes()) {
    const TriangleTree dut(*test.mesh);
    std::vector<int> seen(test.mesh->triangles.size());
    for (const TriangleTree::Node& node : dut.nodes()) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        ++seen[dut.order()[i]];
        const auto& corners = test.mesh->triangles[dut.order()[i]];
        EXPECT_EQ(dut.triangles()[i].a, test.mesh->vertices[corners[0]]);
        for (const std::uint32_t c : corners) EXPECT_FALSE(node.Outside(test.mesh->vertices[c]));
      }
    }
    for (const int times : seen) EXPECT_EQ(times, 1) << test.name;
  }
}

TEST(WindingTreeTest, NumbersAreThoseOfAllTriangles) {
  Random random(3);
  for (const TestMesh& test : TestMeshes()) {
    const TriangleTree tree(*test.mesh);
    const WindingTree dut(test.mesh, tree);
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p = random.Vector(1.5 * test.size_m);
      double angle = 0;
      for (const auto& [a, b, c] : test.mesh->triangles) {
        angle += SolidAngle(test.mesh->vertices[a] - p, test.mesh->vertices[b] - p,
                            test.mesh->vertices[c] - p);
      }
      EXPECT_NEAR(dut.At(p), angle / (4 * std::numbers::pi), 1e-9) << test.name;
    }
  }
}

TEST(WindingTreeTest, ClosedMeshesHaveNoBoundary) {
  for (const TestMesh& test : TestMeshes()) {
    const TriangleTree tree(*test.mesh);
    const bool open = test.name.find("holes") != std::string::npos || test.name == "bowl" ||
                      test.name == "sheet" || test.name == "triangle" ||
                      test.name == "few triangles of a ball";
    EXPECT_EQ(WindingTree(test.mesh, tree).Boundary().empty(), !open) << test.name;
  }
}

}  // namespace
}  // namespace clearway
