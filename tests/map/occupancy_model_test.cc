#include "clearway/map/occupancy_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace clearway {
namespace {

TEST(OccupancyModel, DefaultsAreOctomaps) {
  const OccupancyModel dut;
  EXPECT_NEAR(Dequantized(dut.hit), 0.847298, 2e-4);
  EXPECT_NEAR(Dequantized(dut.miss), -0.405465, 2e-4);
  EXPECT_NEAR(Dequantized(dut.clamp_min), -2.0, 2e-4);
  EXPECT_NEAR(Dequantized(dut.clamp_max), 3.511, 1e-3);
  EXPECT_EQ(dut.occupied, 0);
}

TEST(OccupancyModel, ClampsAtBothEnds) {
  const OccupancyModel dut;
  LogOdds value = 0;
  for (int i = 0; i < 100; ++i) value = dut.AfterHit(value);
  EXPECT_EQ(value, dut.clamp_max);
  for (int i = 0; i < 100; ++i) value = dut.AfterMiss(value);
  EXPECT_EQ(value, dut.clamp_min);
}

TEST(OccupancyModel, ZeroLogOddsIsOccupied) {
  EXPECT_TRUE(OccupancyModel().Occupied(0));
  EXPECT_FALSE(OccupancyModel().Occupied(-1));
}

TEST(OccupancyModel, ProbabilityAndLogOddsAreInverse) {
  for (double p : {0.01, 0.3, 0.5, 0.9}) EXPECT_NEAR(ProbabilityOf(LogOddsOf(p)), p, 1e-12);
}

TEST(OccupancyModel, RefusesEachFieldByName) {
  const auto refuses = [](auto change, const char* field) {
    OccupancyProbabilities p;
    change(p);
    const absl::Status status = Validate(p);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(std::string(status.message()), testing::HasSubstr(field));
  };
  EXPECT_TRUE(Validate(OccupancyProbabilities{}).ok());
  refuses([](auto& p) { p.hit = 0.5; }, "probability_hit");
  refuses([](auto& p) { p.miss = 0.6; }, "probability_miss");
  refuses([](auto& p) { p.clamp_min = NAN; }, "clamp_min");
  refuses([](auto& p) { p.clamp_max = 1.0; }, "clamp_max");
  refuses([](auto& p) { p.occupied = 0.05; }, "occupied_threshold");
}

}  // namespace
}  // namespace clearway
