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

// Points about places all around, over the edges and corners of the cube too: many, or few.
struct Patch {
  int points;
  double surely_deg, perhaps_deg;  // neighbours
};
class Neighbours : public testing::TestWithParam<Patch> {};
TEST_P(Neighbours, AreWithinAboutADegreeOrFew) {
  const double surely_rad = GetParam().surely_deg * kDegree;
  const double perhaps_rad = GetParam().perhaps_deg * kDegree;
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
    for (int i = 0; i < GetParam().points; ++i) ends_W.push_back(near(middle));
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
        surely += angle_rad < surely_rad;
        perhaps += angle_rad < perhaps_rad;
      }
      const DirectionGrid::Votes votes = dut.VotesOn(place);
      EXPECT_EQ(votes.others, 0u);
      EXPECT_LE(votes.fellows, perhaps);
      EXPECT_GE(votes.fellows, surely);
      EXPECT_TRUE(dut.HasFellow(place) || votes.fellows == 0);
    }
    EXPECT_EQ(asked.size(), ends_W.size());
  }
}
INSTANTIATE_TEST_SUITE_P(DirectionGrid, Neighbours,
                         testing::Values(Patch{120, 0.5, 2.8}, Patch{5, 2.4, 11}));

// Two objects of which one stands before the other, and both before a wall. Also so dense that some
// points stand for all.
class MayHaveOthers : public testing::TestWithParam<int> {};
TEST_P(MayHaveOthers, IsTrueWhereOthersVote) {
  Random random(7);
  std::vector<Eigen::Vector3d> ends_W;
  for (int i = 0; i < GetParam(); ++i) {
    const Eigen::Vector3d d = (Eigen::Vector3d(1, 1, 0.2) + random.Vector(0.1)).normalized();
    ends_W.push_back(random.Uniform(8, 14) * d);
  }
  LabelledCloud cloud = CloudOf(ends_W);
  for (std::size_t i = 0; i < ends_W.size(); ++i) {
    cloud.labels[i] = ends_W[i].norm() < 10 ? 1 : ends_W[i].norm() < 12 ? 2 : kStaticLabel;
    if (cloud.labels[i] == kStaticLabel) cloud.kinds[i] = RayEnd::kHit;
  }
  const DirectionGrid dut(cloud);
  std::size_t told = 0, asked = 0;
  for (std::size_t place = 0; place < dut.size(); ++place) {
    if (dut.IsCopy(place)) continue;
    ++asked;
    told += dut.MayHaveOthers(place);
    EXPECT_TRUE(dut.MayHaveOthers(place) || dut.VotesOn(place).others == 0);
  }
  EXPECT_GT(told, asked / 10);
  EXPECT_LT(told, asked * 3 / 4);
}
INSTANTIATE_TEST_SUITE_P(DirectionGrid, MayHaveOthers, testing::Values(600, 20'000));

}  // namespace
}  // namespace clearway
