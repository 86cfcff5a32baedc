#include "scene/direction_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "support/random.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kDegree = std::numbers::pi / 180;

LabelledCloud CloudOf(const std::vector<Eigen::Vector3d>& ends_W) {
  LabelledCloud cloud;
  cloud.origins_W = {Eigen::Vector3f::Zero()};
  for (const Eigen::Vector3d& end_W : ends_W) {
    cloud.ends_W.push_back(end_W.cast<float>());
    cloud.kinds.push_back(RayEnd::kBlock);
    cloud.labels.push_back(1);
  }
  return cloud;
}

// All around, over the edges and corners of the cube too.
TEST(DirectionGrid, NeighboursAreWithinAboutADegree) {
  constexpr double kSurely = 0.5 * kDegree, kPerhaps = 2.8 * kDegree;
  Random random(5);
  const auto near = [&](const Eigen::Vector3d& d) -> Eigen::Vector3d {
    return 10 * (d.normalized() + random.Vector(2 * kDegree)).normalized();
  };
  for (int round = 0; round < 300; ++round) {
    Eigen::Vector3d middle = random.UnitVector();
    // Edges and corners are hit by chance hardly ever.
    if (round % 3 == 1) middle.x() = middle.y();
    if (round % 3 == 2) middle = {middle.x() < 0 ? -1.0 : 1.0, middle.y() < 0 ? -1.0 : 1.0, 1.0};
    std::vector<Eigen::Vector3d> ends_W;
    for (int i = 0; i < 60; ++i) ends_W.push_back(near(middle));
    const DirectionGrid dut(CloudOf(ends_W));
    std::set<std::uint32_t> asked;
    for (std::size_t place = 0; place < dut.size(); ++place) {
      if (dut.IsCopy(place)) continue;
      const Eigen::Vector3d& end_W = ends_W[dut.IndexOf(place)];
      EXPECT_TRUE(asked.insert(dut.IndexOf(place)).second);
      std::uint32_t surely = 0, perhaps = 0;
      for (const Eigen::Vector3d& other_W : ends_W) {
        const double angle_rad = std::acos(std::min(1.0, end_W.dot(other_W) / 100));
        if (&other_W == &end_W) continue;
        surely += angle_rad < kSurely;
        perhaps += angle_rad < kPerhaps;
      }
      const DirectionGrid::Votes votes = dut.VotesOn(place);
      EXPECT_EQ(votes.others, 0u);
      EXPECT_LE(votes.fellows, perhaps);
      EXPECT_GE(votes.fellows, surely);
      EXPECT_TRUE(dut.HasFellow(place) || votes.fellows == 0);
      EXPECT_GE(dut.ObjectPointsAbout(place), votes.fellows);
    }
    EXPECT_EQ(asked.size(), ends_W.size());
  }
}

}  // namespace
}  // namespace clearway
