#include "clearway/geometry/aabb.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace clearway {
namespace {

TEST(Aabb, Empty) {
  const Aabb dut;
  EXPECT_TRUE(dut.Empty());
  EXPECT_EQ(dut.Size(), Eigen::Vector3d::Zero());
  EXPECT_FALSE(dut.Contains(Eigen::Vector3d::Zero()));
  EXPECT_FALSE(dut.Intersects(Aabb{{-1, -1, -1}, {1, 1, 1}}));
  EXPECT_TRUE(Transformed(Pose::Translation(1, 2, 3), dut).Empty());
}

TEST(Aabb, TouchingCountsAsIntersecting) {
  const Aabb dut{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(dut.Intersects({{1, 0, 0}, {2, 1, 1}}));
  EXPECT_FALSE(dut.Intersects({{1.001, 0, 0}, {2, 1, 1}}));
}

TEST(Aabb, IntersectionIsWhatIsInBoth) {
  const Aabb dut{{0, 0, 0}, {4, 2, 1}};
  EXPECT_EQ(Intersection(dut, {{3, -1, -1}, {9, 1, 9}}), (Aabb{{3, 0, 0}, {4, 1, 1}}));
  EXPECT_FALSE(Intersection(dut, {{4, 0, 0}, {5, 1, 1}}).Empty());  // they touch
  EXPECT_TRUE(Intersection(dut, {{4.001, 0, 0}, {5, 1, 1}}).Empty());
  EXPECT_TRUE(Intersection(dut, Aabb{}).Empty());
}

TEST(Aabb, ExtendsByPointsAndBoxes) {
  Aabb dut;
  dut.Extend(Eigen::Vector3d(1, 2, 3));
  dut.Extend(Aabb{{-1, 0, 0}, {0, 5, 0}});
  EXPECT_EQ(dut, (Aabb{{-1, 0, 0}, {1, 5, 3}}));
}

TEST(Aabb, TransformedHoldsEveryCornerAndTouchesThem) {
  testing_support::Random random(1);
  const Aabb box_B{{-1, -2, -3}, {2, 1, 0.5}};
  for (int i = 0; i < 50; ++i) {
    const Pose T_A_B = random.AnyPose(4);
    Aabb corners;
    for (int c = 0; c < 8; ++c) {
      corners.Extend(T_A_B * Eigen::Vector3d(c & 1 ? box_B.min.x() : box_B.max.x(),
                                             c & 2 ? box_B.min.y() : box_B.max.y(),
                                             c & 4 ? box_B.min.z() : box_B.max.z()));
    }
    const Aabb dut = Transformed(T_A_B, box_B);
    EXPECT_LT((dut.min - corners.min).norm() + (dut.max - corners.max).norm(), 1e-12);
  }
}

TEST(Aabb, ClipLeavesThePartOfALineInside) {
  const Aabb box{{0, 0, 0}, {1, 2, 3}};
  const LinePart through = Clip(box, {-1, 1, 1}, {0.5, 0, 0}, {0, 10});
  EXPECT_EQ(through.begin, 2);
  EXPECT_EQ(through.end, 4);
  EXPECT_EQ(Clip(box, {-1, 1, 1}, {0.5, 0, 0}, {0, 3}).end, 3);
  EXPECT_EQ(Clip(box, {0.5, 0.5, 0.5}, {0, 0, -1}, {0, 9}).end, 0.5);
  const LinePart beside = Clip(box, {-1, 2.1, 1}, {1, 0, 0}, {0, 10});
  EXPECT_GT(beside.begin, beside.end);
  const LinePart behind = Clip(box, {2, 1, 1}, {1, 0.1, 0}, {0, 10});
  EXPECT_GT(behind.begin, behind.end);
}

}  // namespace
}  // namespace clearway
