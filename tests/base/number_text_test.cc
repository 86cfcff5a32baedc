#include "clearway/base/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

namespace clearway {
namespace {

TEST(NumberText, HasNoMoreDigitsThanNeeded) {
  EXPECT_EQ(NumberText(0.1), "0.1");
  EXPECT_EQ(NumberText(6.0), "6");
  EXPECT_EQ(NumberText(-2.5), "-2.5");
  EXPECT_EQ(NumberText(100'000.0), "100000");
  EXPECT_EQ(NumberText(1e6), "1e+06");
  EXPECT_EQ(NumberText(0.001), "0.001");
  EXPECT_EQ(NumberText(1e-6), "1e-06");
  EXPECT_EQ(NumberText(0.0), "0");
  EXPECT_EQ(NumberText(0.1F), "0.1");
}

TEST(NumberText, TellsANumberFromALimitNextToIt) {
  EXPECT_EQ(NumberText(6.0000001), "6.0000001");
  for (const double limit : {1.0, 6.0, 0.3333333333333333, 1e5, -1e-4}) {
    EXPECT_NE(NumberText(std::nextafter(limit, 1e9)), NumberText(limit));
  }
}

TEST(NumberText, ReadsBackAsTheSameNumber) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10'000; ++i) {
    double number;
    const std::uint64_t bits = random();
    std::memcpy(&number, &bits, sizeof number);
    if (!std::isfinite(number)) continue;
    EXPECT_EQ(std::strtod(NumberText(number).c_str(), nullptr), number);
  }
}

TEST(NumberText, NamesWhatIsNotFinite) {
  EXPECT_EQ(NumberText(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(NumberText(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace clearway
