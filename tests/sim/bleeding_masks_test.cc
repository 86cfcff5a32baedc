#include "clearway/sim/bleeding_masks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace clearway {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Eigen::Vector3f At(double range_m, double left_deg, double up_deg) {
  const double left = left_deg * kDegree, up = up_deg * kDegree;
  return (range_m * Eigen::Vector3d(std::cos(up) * std::cos(left), std::cos(up) * std::sin(left),
                                    std::sin(up)))
      .cast<float>();
}

TEST(BleedingMasks, TakeWhatIsAroundAndBehind) {
  Frame frame;
  frame.points_S = {At(10, 0, 0),  At(30, 0.4, 0), At(8, 0, -0.4), At(30, 0.6, 0),
                    At(9, 1.3, 0), At(30, 1.0, 0), At(30, 0, 0.4), At(30, -0.4, 0)};
  frame.labels = {3, 0, 0, 0, 5, 0, kIgnoreLabel, 0};
  frame.no_return = {0, 0, 0, 0, 0, 0, 0, 1};
  EXPECT_THAT(WithBleedingMasks(frame, 0.5 * kDegree).labels,
              testing::ElementsAre(3, 3, 3, 0, 5, 5, kIgnoreLabel, 0));
  // The nearest one's.
  EXPECT_THAT(WithBleedingMasks(frame, 1.5 * kDegree).labels,
              testing::ElementsAre(3, 3, 3, 3, 5, 5, kIgnoreLabel, 0));
  EXPECT_EQ(WithBleedingMasks(frame, 0).labels, frame.labels);
}

// Wherever the sensor looks.
TEST(BleedingMasks, AreAsLargeInEveryDirection) {
  for (const double left_deg : {0.0, 90.0, 179.9, -179.9, -45.0}) {
    for (const double up_deg : {-89.0, -45.0, 0.0, 60.0}) {
      Frame frame;
      frame.points_S = {At(10, left_deg, up_deg), At(20, left_deg, up_deg + 0.9),
                        At(20, left_deg, up_deg - 1.1)};
      frame.labels = {3, 0, 0};
      EXPECT_THAT(WithBleedingMasks(frame, kDegree).labels, testing::ElementsAre(3, 3, 0));
    }
  }
}

}  // namespace
}  // namespace clearway
