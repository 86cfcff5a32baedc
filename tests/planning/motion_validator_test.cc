#include "clearway/planning/motion_validator.h"

#include <gtest/gtest.h>

#include "clearway/planning/space_information.h"
#include "planning/fixtures.h"

namespace clearway {
namespace {

namespace ob = ompl::base;

class MotionValidatorTest : public ::testing::Test {
 protected:
  void Use(ob::StateSpacePtr space, const StateMapping& mapping, std::vector<MovingDisc> discs) {
    space_ = space;
    checker_ = std::make_shared<DiscChecker>(DeliveryRobot(), std::move(discs));
    si_ = MakeSpaceInformation(space, checker_, mapping, {}).value();
  }
  void UseSe2(std::vector<MovingDisc> discs) {
    Use(MakeSe2(), StateMapping::Se2(DeliveryRobot(), {}, FixedTime{Time()}), std::move(discs));
  }
  void UseSpaceTime(std::vector<MovingDisc> discs) {
    Use(WithTime(MakeSe2()), StateMapping::Se2(DeliveryRobot(), {}, TimeSince{Time()}),
        std::move(discs));
  }
  const ob::MotionValidator& dut() const { return *si_->getMotionValidator(); }

  ob::StateSpacePtr space_;
  std::shared_ptr<DiscChecker> checker_;
  ob::SpaceInformationPtr si_;
};

TEST_F(MotionValidatorTest, Empty) {
  UseSe2({});
  const auto a = MakeState(space_, {-9, 0, 0}), b = MakeState(space_, {9, 0, 0});
  EXPECT_TRUE(dut().checkMotion(a.get(), b.get()));
  EXPECT_EQ(dut().getValidMotionCount(), 1u);
  EXPECT_EQ(dut().getInvalidMotionCount(), 0u);
}

TEST_F(MotionValidatorTest, OneCallOfTheCheckerForOneMotion) {
  UseSe2({{{3, 0}, {0, 0}, 1}});
  const auto a = MakeState(space_, {-9, 0, 0}), b = MakeState(space_, {9, 0, 0});
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get()));
  EXPECT_EQ(checker_->calls(), 1);
  std::pair<ob::State*, double> last_valid(nullptr, -1);
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get(), last_valid));
  EXPECT_EQ(checker_->calls(), 2);
}

TEST_F(MotionValidatorTest, ADiscInTheMiddleIsFoundThoughBothEndsAreFree) {
  UseSe2({{{0, 0}, {0, 0}, 0.02}});
  const auto a = MakeState(space_, {-9, 0, 0}), b = MakeState(space_, {9, 0, 0});
  EXPECT_TRUE(si_->isValid(a.get()) && si_->isValid(b.get()));
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get()));
  EXPECT_EQ(dut().getInvalidMotionCount(), 1u);
}

TEST_F(MotionValidatorTest, LastValidIsUntouchedByAValidMotion) {
  UseSe2({});
  const auto a = MakeState(space_, {-9, 0, 0}), b = MakeState(space_, {9, 0, 0});
  auto c = MakeState(space_, {1, 2, 3});
  std::pair<ob::State*, double> last_valid(c.get(), 0.123);
  EXPECT_TRUE(dut().checkMotion(a.get(), b.get(), last_valid));
  EXPECT_EQ(last_valid.second, 0.123);
  EXPECT_EQ(c, MakeState(space_, {1, 2, 3}));
}

TEST_F(MotionValidatorTest, LastValidMayBeNull) {
  UseSe2({{{3, 0}, {0, 0}, 1}});
  const auto a = MakeState(space_, {0, 0, 0}), b = MakeState(space_, {3, 0, 0});
  std::pair<ob::State*, double> last_valid(nullptr, -1);
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get(), last_valid));
  EXPECT_NEAR(last_valid.second, 0.5, 0.02);  // contact at x = 1.5
}

TEST_F(MotionValidatorTest, LastValidMayBeAnEndOfTheMotion) {
  UseSe2({{{3, 0}, {0, 0}, 1}});
  auto a = MakeState(space_, {0, 0, 0}), b = MakeState(space_, {3, 0, 0});
  std::pair<ob::State*, double> last_valid(b.get(), -1);
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get(), last_valid));
  EXPECT_NEAR(b[0], 3 * last_valid.second, 1e-12);
  EXPECT_TRUE(si_->isValid(b.get()));
}

TEST_F(MotionValidatorTest, BlockedFromTheStartGivesTheStart) {
  UseSe2({{{1.501, 0}, {0, 0}, 1}});
  const auto a = MakeState(space_, {0, 0, 0}), b = MakeState(space_, {3, 0, 0});
  auto c = MakeState(space_, {7, 7, 0});
  std::pair<ob::State*, double> last_valid(c.get(), -1);
  ASSERT_TRUE(si_->isValid(a.get()));
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get(), last_valid));
  EXPECT_EQ(last_valid.second, 0);
  EXPECT_EQ(c, a);
}

TEST_F(MotionValidatorTest, LastValidStopsAtTheBounds) {
  UseSe2({});
  const auto a = MakeState(space_, {8, 0, 0}), b = MakeState(space_, {12, 0, 0});
  auto c = a;
  std::pair<ob::State*, double> last_valid(c.get(), -1);
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get()));
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get(), last_valid));
  EXPECT_EQ(last_valid.second, 0.5);
  EXPECT_TRUE(space_->satisfiesBounds(c.get()));
}

// Random motions among discs, at rest and moving: the same verdict as a scan of single states, and
// proved free up to where the scan finds contact, within a step.
void CompareWithScan(const ob::SpaceInformation& si) {
  const auto& space = si.getStateSpace();
  const StateQuery& query = *QueryOf(si);
  const auto sampler = space->allocStateSampler();
  ob::ScopedState<> a(space), b(space), c(space), scanned(space);
  int cut = 0;
  for (int i = 0; i < 600; ++i) {
    do {
      sampler->sampleUniform(a.get());
      sampler->sampleUniformNear(b.get(), a.get(), 6);
    } while (!si.isValid(a.get()) || query.CheckMotion(a.get(), b.get())[0].status ==
                                         SpaceStatus::kUnresolved);  // impossible motions
    const std::size_t n = query.CheckMotion(a.get(), b.get()).size();
    std::size_t k = 1;
    for (; k <= n; ++k) {
      space->interpolate(a.get(), b.get(), static_cast<double>(k) / static_cast<double>(n),
                         scanned.get());
      if (!si.isValid(k == n ? b.get() : scanned.get())) break;
    }
    c = a;
    std::pair<ob::State*, double> last_valid(c.get(), -1);
    const bool valid = si.getMotionValidator()->checkMotion(a.get(), b.get(), last_valid);
    ASSERT_EQ(valid, k == n + 1);
    ASSERT_EQ(valid, si.getMotionValidator()->checkMotion(a.get(), b.get()));
    if (valid) continue;
    cut += k > 1;
    const double step = 1 / static_cast<double>(n), blocked = static_cast<double>(k) * step;
    EXPECT_LE(last_valid.second, blocked);
    EXPECT_GE(last_valid.second, blocked - 2 * step);
    space->interpolate(a.get(), b.get(), last_valid.second, scanned.get());
    EXPECT_EQ(c, scanned);
    EXPECT_TRUE(si.isValid(c.get()));
  }
  EXPECT_GT(cut, 30);
}

TEST_F(MotionValidatorTest, LastValidIsWhereAScanEnds) {
  UseSe2({{{3, 0}, {0, 0}, 1}, {{-4, 2}, {0, 0}, 1.5}, {{0, -6}, {0, 0}, 2}});
  CompareWithScan(*si_);
}

TEST_F(MotionValidatorTest, LastValidIsWhereAScanEndsInSpaceTime) {
  UseSpaceTime({{{3, 0}, {0.5, 0}, 1}, {{-4, 2}, {0, -0.5}, 1.5}, {{0, -6}, {-1, 1}, 2}});
  CompareWithScan(*si_);
}

TEST_F(MotionValidatorTest, AMovingDiscBlocksWhenItIsThere) {
  UseSpaceTime({{{-10, 0}, {2, 0}, 1}});  // at the origin at 5 s
  const auto wait = [this](double from_s, double to_s) {
    const auto a = MakeState(space_, {0, 0, 0, from_s}), b = MakeState(space_, {0, 0, 0, to_s});
    return dut().checkMotion(a.get(), b.get());
  };
  EXPECT_TRUE(wait(0, 4));
  EXPECT_FALSE(wait(0, 10));
  EXPECT_TRUE(wait(6, 10));
}

TEST_F(MotionValidatorTest, BackwardsInTimeIsInvalidFromTheStart) {
  UseSpaceTime({});
  const auto a = MakeState(space_, {0, 0, 0, 5}), b = MakeState(space_, {0, 0, 0, 4});
  auto c = b;
  std::pair<ob::State*, double> last_valid(c.get(), -1);
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get()));
  EXPECT_FALSE(dut().checkMotion(a.get(), b.get(), last_valid));
  EXPECT_EQ(last_valid.second, 0);
  EXPECT_EQ(c, a);
  EXPECT_EQ(checker_->calls(), 0);
}

TEST_F(MotionValidatorTest, TooFastIsInvalid) {
  UseSpaceTime({});
  const auto a = MakeState(space_, {0, 0, 0, 0});
  EXPECT_TRUE(dut().checkMotion(a.get(), MakeState(space_, {4, 0, 0, 2}).get()));
  EXPECT_FALSE(dut().checkMotion(a.get(), MakeState(space_, {4, 0, 0, 1.9}).get()));
  EXPECT_FALSE(dut().checkMotion(a.get(), MakeState(space_, {0, 0, 2, 1.9}).get()));
}

}  // namespace
}  // namespace clearway
