#include "server/log.h"

#include <gtest/gtest.h>

#include "clearway/base/time.h"

namespace clearway {
namespace {

TEST(LineBudget, LetsSoManyLinesThroughInASecondAndCountsTheOthers) {
  LineBudget dut(2);
  const LineBudget::Clock::time_point start = LineBudget::Clock::now();
  const auto write_at = [&](double time_s) { return dut.Take(start + FromSeconds(time_s)).write; };
  EXPECT_TRUE(write_at(0));
  EXPECT_TRUE(write_at(0.1));
  EXPECT_FALSE(write_at(0.2));
  EXPECT_FALSE(write_at(0.9));
  const LineBudget::Verdict next = dut.Take(start + std::chrono::seconds(1));
  EXPECT_TRUE(next.write);
  EXPECT_EQ(next.left_out, 2u);
  EXPECT_TRUE(write_at(1.5));
  EXPECT_EQ(dut.Take(start + std::chrono::seconds(9)).left_out, 0u);  // nothing was
}

}  // namespace
}  // namespace clearway
