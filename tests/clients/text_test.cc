#include "cli/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "cli/progress.h"

namespace clearway::cli {
namespace {

TEST(Progress, Empty) { EXPECT_EQ(ProgressText({.total = 0}, 0), "0/0 frames"); }

TEST(Progress, ShowsRatesAndTimeLeft) {
  const ProgressState state{.done = 45, .total = 100, .points = 5'500'000, .elapsed_s = 2.0};
  EXPECT_EQ(ProgressText(state, 10),
            "[====>     ]  45/100 frames  22.5 frames/s  2.75 M points/s  0:03 left");
}

TEST(Progress, ShowsTheWholeTimeAtTheEnd) {
  const ProgressState state{.done = 8, .total = 8, .points = 80, .elapsed_s = 4.0};
  EXPECT_EQ(ProgressText(state, 4), "[====] 8/8 frames  2.0 frames/s  20.0 points/s  in 4.0 s");
}

TEST(Progress, IsPlainLinesElsewhere) {
  std::ostringstream out;
  ProgressBar dut(out, /*is_terminal=*/false, 3);
  dut.Update(3, 10);
  dut.Finish();
  dut.Finish();
  const std::string text = out.str();
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_TRUE(text.starts_with("3/3 frames")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Progress, RedrawsItsLineOnATerminal) {
  std::ostringstream out;
  ProgressBar dut(out, /*is_terminal=*/true, 3);
  dut.Update(1, 10);
  dut.Finish();
  EXPECT_TRUE(out.str().starts_with("\r[")) << out.str();
  EXPECT_TRUE(out.str().ends_with("\n")) << out.str();
}

TEST(Text, Counts) {
  EXPECT_EQ(Grouped(0), "0");
  EXPECT_EQ(Grouped(999), "999");
  EXPECT_EQ(Grouped(1000), "1,000");
  EXPECT_EQ(Grouped(1234567), "1,234,567");
  EXPECT_EQ(Plural(1, "frame"), "1 frame");
  EXPECT_EQ(Plural(2, "frame"), "2 frames");
}

TEST(Text, ScaledKeepsThreeDigits) {
  EXPECT_EQ(Scaled(0), "0");
  EXPECT_EQ(Scaled(12.34), "12.3");
  EXPECT_EQ(Scaled(150.4), "150");
  EXPECT_EQ(Scaled(999.6), "1 k");
  EXPECT_EQ(Scaled(2'812'000), "2.81 M");
}

TEST(Text, SecondsKeepNanoseconds) {
  EXPECT_EQ(Seconds(TimeFromNanoseconds(1'500'000'000)), "1.5 s");
  EXPECT_EQ(Seconds(TimeFromNanoseconds(-1)), "-0.000000001 s");
  EXPECT_EQ(Seconds(TimeFromNanoseconds(0)), "0.0 s");
}

TEST(Text, ClocksRoundUp) {
  EXPECT_EQ(Clock(0), "0:00");
  EXPECT_EQ(Clock(6.2), "0:07");
  EXPECT_EQ(Clock(3723), "1:02:03");
}

TEST(Text, WordsOfAShell) {
  EXPECT_EQ(ShellQuoted("sim:street"), "sim:street");
  EXPECT_EQ(ShellQuoted(""), "''");
  EXPECT_EQ(ShellQuoted("my drive"), "'my drive'");
  EXPECT_EQ(ShellQuoted("it's $1"), R"('it'\''s $1')");
}

TEST(Text, NothingHasNoSize) {
  EXPECT_EQ(Size(Eigen::Vector3d::Zero()), "-");
  EXPECT_EQ(Size({4.31, 1.8, 1.625}), "4.31 x 1.80 x 1.62 m");
}

}  // namespace
}  // namespace clearway::cli
