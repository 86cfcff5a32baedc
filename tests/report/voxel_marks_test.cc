#include "report/voxel_marks.h"

#include <gtest/gtest.h>

#include <set>

#include "clearway/scene/moving_object.h"
#include "support/random.h"

namespace clearway {
namespace {

std::set<VoxelKey> Marked(const VoxelMarks& marks) {
  std::set<VoxelKey> keys;
  marks.ForEachMarked([&](VoxelKey key) { keys.insert(key); });
  return keys;
}

// Row by row, as point by point.
TEST(VoxelMarks, MarksTheVoxelsOfAHull) {
  testing_support::Random random(3);
  const VoxelGrid grid(0.1);
  for (int trial = 0; trial < 20; ++trial) {
    VoxelMap map_O(0.1);
    for (int i = 0; i < 30; ++i) {
      map_O.Set(grid.KeyOf(random.Vector(1)), map_O.model().clamp_max);
    }
    const auto solid = SolidOf(map_O);
    const Pose T_W_O = random.AnyPose(5);
    const Pose T_O_W = Inverse(T_W_O);
    const Aabb box_W = Transformed(T_W_O, solid->box_O);
    VoxelMarks dut(grid, box_W), reference(grid, box_W);
    dut.MarkHull(*solid->hull, T_O_W);
    reference.MarkIf(
        [&](const Eigen::Vector3d& p_W) { return NearHull(*solid->hull, T_O_W * p_W, 0); });
    EXPECT_GT(Marked(reference).size(), 500u);
    EXPECT_EQ(Marked(dut), Marked(reference));
  }
}

TEST(VoxelMarks, NothingIsMarkedOutsideOfTheBox) {
  const VoxelGrid grid(1);
  VoxelMarks dut(grid, Aabb{{0.5, 0.5, 0.5}, {2.5, 1.5, 1.5}});
  EXPECT_FALSE(dut.AtOrBeside({1, 0, 0}));
  dut.MarkIf([](const Eigen::Vector3d& p_W) { return p_W.x() > 2; });
  EXPECT_EQ(Marked(dut).size(), 4u);
  EXPECT_TRUE(dut.AtOrBeside({2, 0, 0}));
  EXPECT_TRUE(dut.AtOrBeside({3, -1, 2}));
  EXPECT_TRUE(dut.AtOrBeside({1, 0, 0}));
  EXPECT_FALSE(dut.AtOrBeside({0, 0, 0}));
  EXPECT_FALSE(dut.AtOrBeside({4, 0, 0}));
  EXPECT_FALSE(dut.AtOrBeside({100'000, 0, 0}));
}

TEST(VoxelMarks, Empty) {
  VoxelMarks dut(VoxelGrid(0.1), Aabb{});
  dut.MarkIf([](const Eigen::Vector3d&) { return true; });
  EXPECT_TRUE(Marked(dut).empty());
  EXPECT_FALSE(dut.AtOrBeside({0, 0, 0}));
}

}  // namespace
}  // namespace clearway
