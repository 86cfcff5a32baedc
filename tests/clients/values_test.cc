#include "cli/values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clearway::cli {
namespace {

TEST(ParseTime, Empty) { EXPECT_FALSE(ParseTime("").ok()); }

TEST(ParseTime, AbsoluteSecondsKeepEveryNanosecond) {
  const auto time = ParseTime("1700000000.123456789");
  ASSERT_TRUE(time.ok()) << time.status();
  EXPECT_FALSE(time->relative);
  EXPECT_EQ(ToNanoseconds(time->At(Time())), 1700000000123456789);
}

TEST(ParseTime, PlusIsAfterTheNewestStamp) {
  const auto time = ParseTime("+1.5");
  ASSERT_TRUE(time.ok()) << time.status();
  EXPECT_EQ(time->At(TimeFromNanoseconds(2'000'000'000)), TimeFromNanoseconds(3'500'000'000));
}

TEST(ParseTime, NowMinusIsBeforeTheNewestStamp) {
  const auto time = ParseTime("now-0.25");
  ASSERT_TRUE(time.ok()) << time.status();
  EXPECT_EQ(time->At(TimeFromNanoseconds(1'000'000'000)), TimeFromNanoseconds(750'000'000));
}

TEST(ParseTime, AbsoluteTimesMayLieBeforeTheEpoch) {
  const auto time = ParseTime("-.5");
  ASSERT_TRUE(time.ok()) << time.status();
  EXPECT_EQ(time->At(TimeFromNanoseconds(7)), TimeFromNanoseconds(-500'000'000));
}

TEST(ParseTime, RefusesWhatIsNoTime) {
  for (const char* text : {"soon", "+", ".", "1.5s", "1e3", "1.0123456789", "99999999999", "now1",
                           "--1", "+-1", "1,5", "nan"}) {
    EXPECT_FALSE(ParseTime(text).ok()) << text;
  }
}

TEST(ParseBox, SortsItsCorners) {
  const auto box = ParseBox("1,2,3, -1,-2,-3");
  ASSERT_TRUE(box.ok()) << box.status();
  EXPECT_EQ(box->min, Eigen::Vector3d(-1, -2, -3));
  EXPECT_EQ(box->max, Eigen::Vector3d(1, 2, 3));
}

TEST(ParseOrderedBox, TakesTheLowestCornerFirst) {
  const auto box = ParseOrderedBox("-1,-2,-3,1,2,-3");
  ASSERT_TRUE(box.ok()) << box.status();
  EXPECT_EQ(box->min, Eigen::Vector3d(-1, -2, -3));
  EXPECT_EQ(box->max, Eigen::Vector3d(1, 2, -3));
}

TEST(ParseOrderedBox, RefusesCornersTheOtherWayRound) {
  EXPECT_EQ(ParseOrderedBox("0,5,0,1,2,1").status().message(),
            "'0,5,0,1,2,1': y0 must not exceed y1; give the lowest corner first");
  for (const char* text : {"", "0,0,0,1,1", "0,0,0,1,1,1,1", "0,0,0,1,1,nan", "-inf,0,0,1,1,1"}) {
    EXPECT_FALSE(ParseOrderedBox(text).ok()) << text;
  }
}

TEST(ParsePoint, RefusesWhatIsNoPoint) {
  for (const char* text : {"", "1,2", "1,2,3,4", "1,2,x", "1,2,inf", "1;2;3"}) {
    EXPECT_FALSE(ParsePoint(text).ok()) << text;
  }
}

TEST(ParseSolidBox, RefusesBoxesWithoutExtent) {
  EXPECT_TRUE(ParseSolidBox("0,0,0,1,1,0.1").ok());
  EXPECT_EQ(ParseSolidBox("0,0,0,1,1,0").status().message(),
            "'0,0,0,1,1,0': the box has no extent along z; it would keep nothing out");
  EXPECT_FALSE(ParseSolidBox("1,1,1,1,1,1").ok());
  EXPECT_FALSE(ParseSolidBox("1,0,0,0,1,1").ok());
}

TEST(ParseNumbers, AreDecimal) {
  for (const char* text : {"0x10", "-0X1p3", "0x", "1,0x10"}) {
    EXPECT_FALSE(ParseNumbers(text).ok()) << text;
  }
  EXPECT_FALSE(ParseBox("0x1,0,0,2,2,2").ok());
  EXPECT_FALSE(ParseOrderedBox("0x1,0,0,2,2,2").ok());
  EXPECT_FALSE(ParsePoint("0x1,0,0").ok());
  EXPECT_EQ(*ParseFinite("010"), 10);
  EXPECT_EQ(*ParseFinite("1e3"), 1000);
}

TEST(ParseTime, SaysWhyAnExponentIsRefused) {
  EXPECT_THAT(std::string(ParseTime("1e30").status().message()),
              testing::HasSubstr("without an exponent, at most nine decimals and 9000000000"));
}

TEST(ParsePoint, NamesWhatItFound) {
  EXPECT_EQ(ParsePoint("1,2").status().message(), "expected x,y,z in metres, not '1,2'");
}

}  // namespace
}  // namespace clearway::cli
