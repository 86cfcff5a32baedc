#include "clearway/base/time.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

TEST(Time, RoundsSecondsToTheNearestNanosecond) {
  EXPECT_EQ(FromSeconds(0.1).count(), 100'000'000);
  EXPECT_EQ(FromSeconds(-0.1).count(), -100'000'000);
  EXPECT_EQ(FromSeconds(1.2345678916).count(), 1'234'567'892);
}

TEST(Time, SecondsComeBack) { EXPECT_DOUBLE_EQ(ToSeconds(FromSeconds(12.5)), 12.5); }

TEST(Time, NanosecondsComeBack) { EXPECT_EQ(ToNanoseconds(TimeFromNanoseconds(-7)), -7); }

}  // namespace
}  // namespace clearway
