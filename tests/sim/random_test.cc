#include "sim/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clearway {
namespace {

TEST(RandomTest, SameStreamSameNumbers) {
  Random a(7, 3, 2), b(7, 3, 2);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.Normal(), b.Normal());
}

TEST(RandomTest, SeedStreamAndIndexEachMakeAnotherSequence) {
  const double first = Random(7, 3, 2).Uniform();
  EXPECT_NE(first, Random(8, 3, 2).Uniform());
  EXPECT_NE(first, Random(7, 4, 2).Uniform());
  EXPECT_NE(first, Random(7, 3, 3).Uniform());
}

TEST(RandomTest, UniformFillsTheOpenUnitInterval) {
  Random dut(1, 0);
  double sum = 0, least = 1, most = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = dut.Uniform();
    sum += x;
    least = std::min(least, x);
    most = std::max(most, x);
  }
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 1e-3);
  EXPECT_LT(most, 1);
  EXPECT_GT(most, 1 - 1e-3);
  EXPECT_NEAR(sum / 100'000, 0.5, 0.005);
}

TEST(RandomTest, NormalHasTheMomentsOfTheNormalDistribution) {
  Random dut(1, 0);
  constexpr int kCount = 200'000;
  double sum = 0, squares = 0, fourths = 0, products = 0, last = 0;
  for (int i = 0; i < kCount; ++i) {
    const double x = dut.Normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    products += x * last;
    last = x;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.01);
  EXPECT_NEAR(squares / kCount, 1, 0.02);
  EXPECT_NEAR(fourths / kCount, 3, 0.1);
  EXPECT_NEAR(products / kCount, 0, 0.01);  // successive numbers are independent
}

}  // namespace
}  // namespace clearway
