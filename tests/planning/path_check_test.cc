#include "clearway/planning/path_check.h"

#include <gtest/gtest.h>

#include "clearway/planning/space_information.h"
#include "planning/fixtures.h"

namespace clearway {
namespace {

namespace og = ompl::geometric;

class PathCheckTest : public ::testing::Test {
 protected:
  void Use(std::vector<MovingDisc> discs) {
    checker_ = std::make_shared<DiscChecker>(DeliveryRobot(), std::move(discs));
    si_ = MakeSpaceInformation(space_, checker_,
                               StateMapping::R2(DeliveryRobot(), {}, TimeSince{Time()}), {})
              .value();
    path_ = std::make_unique<og::PathGeometric>(si_);
  }
  void Append(double x_m, double y_m, double seconds) {
    path_->append(MakeState(space_, {x_m, y_m, seconds}).get());
  }

  std::shared_ptr<SpaceTimeStateSpace> space_ = WithTime(MakeRn(2));
  std::shared_ptr<DiscChecker> checker_;
  ompl::base::SpaceInformationPtr si_;
  std::unique_ptr<og::PathGeometric> path_;
};

TEST_F(PathCheckTest, Empty) {
  Use({});
  const PathCheck dut = CheckPath(*path_, *QueryOf(*si_));
  EXPECT_FALSE(dut.free);
  EXPECT_TRUE(dut.answers.empty());
}

TEST_F(PathCheckTest, TimedPosesAreThePathsStates) {
  Use({});
  Append(0, -4, 0);
  Append(0, 4, 5);
  const auto poses = TimedPoses(*path_, QueryOf(*si_)->mapping()).value();
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[1].time, TimeFromNanoseconds(5'000'000'000));
  EXPECT_TRUE(poses[1].T_W_L.translation.isApprox(Eigen::Vector3d(0, 4, 0.65)));
}

TEST_F(PathCheckTest, AFreePathIsFree) {
  Use({{{-10, 0}, {7, 0}, 1}});
  Append(0, -4, 0);
  Append(0, -4, 3);  // waits for the disc to pass
  Append(0, 4, 8);
  checker_->unknown_fraction = 0.25;
  const PathCheck dut = CheckPath(*path_, *QueryOf(*si_));
  EXPECT_TRUE(dut.free);
  EXPECT_EQ(dut.first_blocked, std::nullopt);
  EXPECT_EQ(dut.answers.size(), dut.times.size());
  EXPECT_EQ(dut.answers.size(), 1u + 120u + 200u);
  EXPECT_EQ(dut.times.front(), Time());
  EXPECT_EQ(dut.times.back(), TimeFromNanoseconds(8'000'000'000));
  EXPECT_EQ(dut.unknown_fraction, 0.25);
}

TEST_F(PathCheckTest, ABlockedPathTellsWhere) {
  Use({{{-14, 0}, {7, 0}, 1}});  // at the origin at 2 s
  Append(0, -4, 0);
  Append(0, 4, 4);
  const PathCheck dut = CheckPath(*path_, *QueryOf(*si_));
  EXPECT_FALSE(dut.free);
  ASSERT_TRUE(dut.first_blocked.has_value());
  const Time first = dut.times[*dut.first_blocked];
  EXPECT_GT(first, TimeFromNanoseconds(1'500'000'000));
  EXPECT_LT(first, TimeFromNanoseconds(2'500'000'000));
  EXPECT_EQ(dut.answers[*dut.first_blocked].status, SpaceStatus::kOccupied);
}

TEST_F(PathCheckTest, AnImpossibleMotionIsNotFree) {
  Use({});
  Append(0, -4, 3);
  Append(0, -4, 2);
  const PathCheck dut = CheckPath(*path_, *QueryOf(*si_));
  EXPECT_FALSE(dut.free);
  ASSERT_EQ(dut.answers.size(), 2u);
  EXPECT_EQ(dut.answers[1].status, SpaceStatus::kUnresolved);
  EXPECT_EQ(dut.times[1], TimeFromNanoseconds(2'000'000'000));
}

}  // namespace
}  // namespace clearway
