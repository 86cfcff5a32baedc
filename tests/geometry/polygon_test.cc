#include "clearway/geometry/polygon.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

TEST(ConvexOutline, Empty) { EXPECT_TRUE(ConvexOutline({}).empty()); }

TEST(ConvexOutline, DropsInnerPointsAndTurnsLeft) {
  const Polygon dut = ConvexOutline({{1, 1}, {0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}});
  ASSERT_EQ(dut.size(), 4u);
  double area2 = 0;
  for (std::size_t i = 0; i < dut.size(); ++i) {
    const Eigen::Vector2d a = dut[i], b = dut[(i + 1) % dut.size()];
    area2 += a.x() * b.y() - a.y() * b.x();
  }
  EXPECT_DOUBLE_EQ(area2, 8);
}

}  // namespace
}  // namespace clearway
