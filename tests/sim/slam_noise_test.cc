#include "clearway/sim/slam_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clearway {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr Duration kPeriod = std::chrono::milliseconds(100);

struct Means {
  double rotation_rad = 0;
  double translation_m = 0;
};

Means MeanOf(const std::vector<Pose>& errors) {
  Means means;
  for (const Pose& error : errors) {
    means.rotation_rad += Log(error).angular.norm() / static_cast<double>(errors.size());
    means.translation_m += error.translation.norm() / static_cast<double>(errors.size());
  }
  return means;
}

// The errors of the motions from one frame to the next, in B: error(k) * error(k-1)^-1.
std::vector<Pose> Steps(const std::vector<Pose>& errors) {
  std::vector<Pose> steps;
  for (std::size_t k = 1; k < errors.size(); ++k) {
    steps.push_back(errors[k] * Inverse(errors[k - 1]));
  }
  return steps;
}

TEST(SlamNoiseTest, EmptyIsNoError) {
  for (const Pose& error : ErrorsOfRun({}, 10, kPeriod, 1, 0)) EXPECT_EQ(error, Pose());
}

TEST(SlamNoiseTest, MeansOfARunAreExactWhateverItsLength) {
  const PoseErrorModel model{0.05, 0.3, FromSeconds(2), FromSeconds(1), false};
  for (const std::size_t count : {1u, 2u, 17u, 300u}) {
    const Means means = MeanOf(ErrorsOfRun(model, count, kPeriod, 4, 2));
    EXPECT_NEAR(means.rotation_rad, 0.05, 1e-12);
    EXPECT_NEAR(means.translation_m, 0.3, 1e-12);
  }
}

TEST(SlamNoiseTest, OneOfTheTwoMayBeZero) {
  const Means means = MeanOf(ErrorsOfRun({0.05, 0, {}, {}, false}, 50, kPeriod, 4, 2));
  EXPECT_NEAR(means.rotation_rad, 0.05, 1e-12);
  EXPECT_EQ(means.translation_m, 0);
}

TEST(SlamNoiseTest, ErrorIsCorrelatedOverItsCorrelationTime) {
  const PoseErrorModel model{0.1, 1, FromSeconds(0.5), FromSeconds(2), false};
  const auto errors = ErrorsOfRun(model, 50'000, kPeriod, 9, 0);
  const auto correlation = [&](std::size_t lag) {
    double product = 0, square = 0;
    for (std::size_t k = 0; k + lag < errors.size(); ++k) {
      product += errors[k].translation.dot(errors[k + lag].translation);
      square += errors[k].translation.squaredNorm();
    }
    return product / square;
  };
  EXPECT_NEAR(correlation(1), std::exp(-0.1 / 2), 0.02);
  EXPECT_NEAR(correlation(20), std::exp(-1), 0.05);
  EXPECT_NEAR(correlation(200), 0, 0.08);
}

TEST(SlamNoiseTest, ZeroCorrelationIsWhite) {
  const auto errors = ErrorsOfRun({0, 1, {}, {}, false}, 20'000, kPeriod, 9, 0);
  // Independent steps: sqrt(2) of the error itself.
  EXPECT_NEAR(MeanOf(Steps(errors)).translation_m, std::sqrt(2), 0.02);
}

TEST(SlamNoiseTest, DriftStartsAtTheTruth) {
  const auto errors = ErrorsOfRun(SlamNoise::TableOne().sensor, 300, kPeriod, 5, 0);
  EXPECT_EQ(errors[0], Pose());
  // And leaves it slowly: no step is near the mean error.
  for (const Pose& step : Steps(errors)) EXPECT_LT(step.translation.norm(), 0.2);
}

TEST(SlamNoiseTest, TableOneMeansAreThePapers) {
  const SlamNoise dut = SlamNoise::TableOne(kPeriod);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Means camera = MeanOf(ErrorsOfRun(dut.sensor, 555, kPeriod, seed, 0));
    EXPECT_NEAR(camera.rotation_rad, 2.09 * kRadPerDeg, 1e-9);
    EXPECT_NEAR(camera.translation_m, 0.29, 1e-9);

    const auto errors = ErrorsOfRun(dut.object, 555, kPeriod, seed, 1);
    const Means pose = MeanOf(errors);
    EXPECT_NEAR(pose.rotation_rad, 2.91 * kRadPerDeg, 1e-9);
    EXPECT_NEAR(pose.translation_m, 0.57, 1e-9);
    const Means motion = MeanOf(Steps(errors));
    EXPECT_NEAR(motion.rotation_rad, 1.89 * kRadPerDeg, 0.1 * 1.89 * kRadPerDeg);
    EXPECT_NEAR(motion.translation_m, 0.54, 0.1 * 0.54);
  }
}

TEST(SlamNoiseTest, TableOneHoldsAtOtherFrameRates) {
  const Duration period = FromSeconds(1.0 / 15);
  const auto errors = ErrorsOfRun(SlamNoise::TableOne(period).object, 2'000, period, 1, 1);
  const Means motion = MeanOf(Steps(errors));
  EXPECT_NEAR(motion.rotation_rad, 1.89 * kRadPerDeg, 0.1 * 1.89 * kRadPerDeg);
  EXPECT_NEAR(motion.translation_m, 0.54, 0.1 * 0.54);
}

TEST(SlamNoiseTest, SeedsAndStreamsDiffer) {
  const PoseErrorModel model = SlamNoise::TableOne().object;
  const auto errors = ErrorsOfRun(model, 5, kPeriod, 1, 1);
  EXPECT_EQ(errors, ErrorsOfRun(model, 5, kPeriod, 1, 1));
  EXPECT_NE(errors, ErrorsOfRun(model, 5, kPeriod, 2, 1));
  EXPECT_NE(errors, ErrorsOfRun(model, 5, kPeriod, 1, 2));
}

}  // namespace
}  // namespace clearway
