#include "scene/direction_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

struct Expected {
  int face;
  double u, v;  // in cells
};

// By definition, but for how near a cell's middle the arcus tangent is.
Expected CellOf(const Eigen::Vector3d& d, int across) {
  int axis = 0;
  d.cwiseAbs().maxCoeff(&axis);
  const auto along = [&](int other) {
    const double slope = d[other] / std::abs(d[axis]);
    return (4 / std::numbers::pi * std::atan(slope) + 1) * across / 2;
  };
  return {2 * axis + (d[axis] < 0), along((axis + 1) % 3), along((axis + 2) % 3)};
}

TEST(DirectionCells, AreOfEqualAnglesOnTheFacesOfACube) {
  const Eigen::Vector3f from_W(3, -2, 1);
  Random random(3);
  for (int count = 1; count < 200; ++count) {
    std::vector<Eigen::Vector3f> points_W;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d d = random.Uniform(0.5, 50) * random.UnitVector();
      points_W.push_back(from_W + d.cast<float>());
    }
    const int across = count % 2 == 0 ? DirectionCells::kMostAcross : 25;
    std::vector<std::uint32_t> cells(count);
    DirectionCells(across).Find(points_W, from_W, cells.data());
    for (int i = 0; i < count; ++i) {
      const auto [face, u, v] = CellOf((points_W[i] - from_W).cast<double>(), across);
      const int place = static_cast<int>(cells[i]) - DirectionCells::kBefore;
      const int row = place / DirectionCells::kRow;
      EXPECT_EQ(row / DirectionCells::kRow, face);
      EXPECT_NEAR(place % DirectionCells::kRow - 1, u - 0.5, 1);
      EXPECT_NEAR(row % DirectionCells::kRow - 1, v - 0.5, 1);
    }
  }
}

TEST(DirectionCells, OfASensorsOwnPlaceIsOne) {
  const std::vector<Eigen::Vector3f> points_W(9, {1, 2, 3});
  std::vector<std::uint32_t> cells(9);
  DirectionCells().Find(points_W, points_W[0], cells.data());
  const std::uint32_t in_the_middle = DirectionCells::kBefore + 51 * DirectionCells::kRow + 51;
  for (const std::uint32_t cell : cells) EXPECT_EQ(cell, in_the_middle);
}

// Beyond the edge it goes on as if the face were larger: by the neighbour of the cell that would
// lie there.
class RimsOfDirectionCells : public testing::TestWithParam<int> {};
TEST_P(RimsOfDirectionCells, AreOfTheFacesBeside) {
  const int across = GetParam();
  const DirectionCells dut(across);
  Random random(4);
  int in_rims = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3f d = random.UnitVector().cast<float>();
    std::uint32_t own = 0;
    dut.Find({&d, 1}, Eigen::Vector3f::Zero(), &own);
    dut.ForEachInRims(own, d, [&](std::uint32_t cell) {
      ++in_rims;
      const int place = static_cast<int>(cell) - DirectionCells::kBefore;
      const int row = place / DirectionCells::kRow, face = row / DirectionCells::kRow;
      EXPECT_NE(face, CellOf(d.cast<double>(), across).face);
      const int axis = face / 2;
      EXPECT_EQ(d[axis] < 0, face % 2 == 1);
      const auto slope = [&](int other) { return d[other] / std::abs(d[axis]); };
      // One of the two places lies in the rim or beside it.
      const double u = std::abs(slope((axis + 1) % 3)), v = std::abs(slope((axis + 2) % 3));
      EXPECT_GT(std::max(u, v), 1);
      EXPECT_LT(std::max(u, v), 1 + 7.0 / across);
      const int at_u = place % DirectionCells::kRow, at_v = row % DirectionCells::kRow;
      EXPECT_TRUE(at_u == 0 || at_u > across || at_v == 0 || at_v > across);
    });
  }
  EXPECT_GT(in_rims, 500);
}
INSTANTIATE_TEST_SUITE_P(DirectionCells, RimsOfDirectionCells,
                         testing::Values(DirectionCells::kMostAcross, 40, 25));

}  // namespace
}  // namespace clearway
