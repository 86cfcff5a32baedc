#include "clearway/map/resolution.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

TEST(SameResolution, AsFarAsSixDigitsTell) {
  EXPECT_TRUE(SameResolution(0.333333, 1.0 / 3));
  EXPECT_TRUE(SameResolution(0.666667, 2.0 / 3));
  EXPECT_TRUE(SameResolution(0.1, 0.1));
  EXPECT_FALSE(SameResolution(0.1, 0.100001));
  EXPECT_FALSE(SameResolution(0.333333, 0.333335));
  EXPECT_FALSE(SameResolution(0.1, 0.2));
}

}  // namespace
}  // namespace clearway
