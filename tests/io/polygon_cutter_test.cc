#include "io/polygon_cutter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace clearway {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Corners = std::vector<Eigen::Vector3d>;
using Triangle = std::array<std::uint32_t, 3>;

Eigen::Vector3d AreaOf(const Corners& corners, const Triangle& t) {
  return (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]) / 2;
}

// Cuts a simple polygon. Its triangles cover it once: they are turned as it is and have its area.
void ExpectCovered(const Corners& corners) {
  PolygonCutter dut;
  ASSERT_TRUE(dut.Cut(corners).ok());
  ASSERT_EQ(dut.triangles().size(), corners.size() - 2);
  Eigen::Vector3d polygon = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    polygon += corners[i].cross(corners[(i + 1) % corners.size()]) / 2;
  }
  double area = 0;
  for (const Triangle& triangle : dut.triangles()) {
    EXPECT_GT(AreaOf(corners, triangle).dot(polygon), 0);
    area += AreaOf(corners, triangle).norm();
  }
  EXPECT_NEAR(area, polygon.norm(), 1e-9 * polygon.norm());
}

Corners Moved(const Corners& corners, const Eigen::Isometry3d& motion) {
  Corners moved;
  for (const Eigen::Vector3d& corner : corners) moved.push_back(motion * corner);
  return moved;
}

std::string ErrorOf(const Corners& corners) {
  PolygonCutter dut;
  const absl::Status status = dut.Cut(corners);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(dut.triangles(), IsEmpty());
  return std::string(status.message());
}

TEST(PolygonCutter, Empty) {
  PolygonCutter dut;
  for (const Corners& corners : {Corners{}, Corners{{1, 2, 3}}, Corners(5, {1, 2, 3})}) {
    EXPECT_TRUE(dut.Cut(corners).ok());
    EXPECT_THAT(dut.triangles(), IsEmpty());
  }
}

TEST(PolygonCutter, ConvexOnesBecomeFans) {
  PolygonCutter dut;
  ASSERT_TRUE(dut.Cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).ok());
  EXPECT_THAT(dut.triangles(), ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  ASSERT_TRUE(dut.Cut({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {0, -1, 0.5}}).ok());
  EXPECT_THAT(dut.triangles(),
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
}

TEST(PolygonCutter, ConcaveOnesAreCoveredOnce) {
  ExpectCovered({{0, 0, 0}, {1, 2, 0}, {0, 1, 0}, {-1, 2, 0}});  // a dart
  ExpectCovered({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  ExpectCovered({{0, 0, 0},
                 {5, 0, 0},
                 {5, 5, 0},
                 {1, 5, 0},
                 {1, 2, 0},
                 {3, 2, 0},
                 {3, 3, 0},
                 {2, 3, 0},
                 {2, 4, 0},
                 {4, 4, 0},
                 {4, 1, 0},
                 {0, 1, 0}});  // a spiral
}

TEST(PolygonCutter, CornersOnStraightEdgesStay) {
  // A triangle that left them out would not meet its neighbours' edges.
  ExpectCovered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}});
  ExpectCovered(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  ExpectCovered({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {2, 2, 0}});
}

TEST(PolygonCutter, RandomOnesAreCoveredOnceHoweverTheyLie) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int n = 3; n < 203; ++n) {
    Corners star;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.9 * uniform(random)) / n;
      const double radius = 0.1 + uniform(random);
      star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    const Eigen::Isometry3d motion =
        Eigen::Translation3d(uniform(random), 2, -1) *
        Eigen::AngleAxisd(6 * uniform(random),
                          Eigen::Vector3d(uniform(random), uniform(random), 0.1).normalized());
    ExpectCovered(Moved(star, motion));
    ExpectCovered(Moved(Corners(star.rbegin(), star.rend()), motion));
  }
}

TEST(PolygonCutter, LargeOnesAreCutAndTooLargeOnesRefused) {
  Corners comb = {{500, -1e4, 0}};
  while (comb.size() < 1000) {
    const double i = static_cast<double>(comb.size());
    comb.push_back({1000 - i, comb.size() % 2 == 0 ? 0.0 : 1.0, 0});
  }
  ExpectCovered(comb);
  comb.resize(PolygonCutter::kMaxCorners + 1, {0, 0, 0});
  EXPECT_THAT(ErrorOf(comb), HasSubstr("has 10001 corners; the limit is 10000"));
}

TEST(PolygonCutter, TheWorkIsLimited) {
  PolygonCutter dut;
  Corners circle;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    circle.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (int i = 0; i < 2000; ++i) ASSERT_TRUE(dut.Cut(circle).ok());  // convex ones are no work
  std::swap(circle[1], circle[2]);                                   // crosses itself
  absl::Status status;
  int cut = 0;
  for (; !absl::IsResourceExhausted(status); ++cut) status = dut.Cut(circle);
  EXPECT_EQ(cut, 1001);
}

TEST(PolygonCutter, RepeatedCornersCountOnce) {
  PolygonCutter dut;
  ASSERT_TRUE(dut.Cut({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}).ok());
  EXPECT_THAT(dut.triangles(), ElementsAre(Triangle{0, 1, 3}));
}

TEST(PolygonCutter, CornersNeedNotLieInAPlane) {
  PolygonCutter dut;
  ASSERT_TRUE(dut.Cut({{0, 0, 0}, {1, 0, 0.4}, {1, 1, 0}, {0, 1, 0.4}}).ok());
  EXPECT_EQ(dut.triangles().size(), 2u);
}

TEST(PolygonCutter, OnesThatCrossOrTouchThemselvesAreRefused) {
  EXPECT_THAT(ErrorOf({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), HasSubstr("crosses"));
  EXPECT_THAT(ErrorOf({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 3, 0}}), HasSubstr("crosses"));
  Corners pentagram;  // turns left at each corner, but twice around
  for (int i = 0; i < 5; ++i) {
    const double angle = 4 * std::numbers::pi * i / 5;
    pentagram.push_back({std::cos(angle), std::sin(angle), 0});
  }
  EXPECT_THAT(ErrorOf(pentagram), HasSubstr("crosses"));
  const Corners square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  Corners twice = square;
  twice.insert(twice.end(), square.begin(), square.end());
  EXPECT_THAT(ErrorOf(twice), HasSubstr("touches"));
  EXPECT_THAT(ErrorOf({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 2, 0}}),
              HasSubstr("touches"));  // a corner on an edge
  EXPECT_THAT(ErrorOf({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 1, 0}, {0, 1, 0}}),
              HasSubstr("touches"));  // back along an edge
  EXPECT_THAT(ErrorOf({{0, 0, 0}, {1e300, 0, 0}, {1e300, 1e300, 0}, {0, 1e300, 0}}),
              HasSubstr("too large"));
}

TEST(PolygonCutter, SliversMayCrossThemselves) {
  PolygonCutter dut;
  ASSERT_TRUE(dut.Cut({{0, 0, 0}, {1, 1e-6, 0}, {1, 0, 0}, {0, 1e-6, 0}}).ok());
  EXPECT_EQ(dut.triangles().size(), 2u);
  ASSERT_TRUE(dut.Cut({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {1.5, 1.5, 1.5}}).ok());  // without area
  EXPECT_EQ(dut.triangles().size(), 2u);
}

}  // namespace
}  // namespace clearway
