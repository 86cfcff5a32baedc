#include "clearway/planning/validity_checker.h"

#include <gtest/gtest.h>

#include <thread>

#include "clearway/planning/space_information.h"
#include "planning/fixtures.h"

namespace clearway {
namespace {

namespace ob = ompl::base;

StateMapping Mapping() { return StateMapping::Se2(DeliveryRobot(), {}, FixedTime{Time()}); }

ob::SpaceInformationPtr Make(std::shared_ptr<const StateChecker> checker,
                             const PlanningOptions& options = {}) {
  return MakeSpaceInformation(MakeSe2(), std::move(checker), Mapping(), options).value();
}

const MovingDisc kDiscAhead{{3, 0}, {0, 0}, 1.0};

TEST(SceneValidityChecker, Empty) {
  const auto si = Make(std::make_shared<DiscChecker>(DeliveryRobot(), std::vector<MovingDisc>{}));
  EXPECT_TRUE(si->isValid(MakeState(si->getStateSpace(), {0, 0, 0}).get()));
  ASSERT_NE(QueryOf(*si), nullptr);
  EXPECT_EQ(QueryOf(*si)->checker().version(), 7u);
}

TEST(SceneValidityChecker, ContactIsInvalid) {
  const auto si = Make(std::make_shared<DiscChecker>(DeliveryRobot(), std::vector{kDiscAhead}));
  EXPECT_TRUE(si->isValid(MakeState(si->getStateSpace(), {1.45, 0, 0}).get()));
  EXPECT_FALSE(si->isValid(MakeState(si->getStateSpace(), {1.55, 0, 0}).get()));
  // Turned, it is shorter.
  EXPECT_TRUE(si->isValid(MakeState(si->getStateSpace(), {1.55, 0, kHalfTurn / 2}).get()));
}

TEST(SceneValidityChecker, OutOfBoundsIsInvalid) {
  const auto si = Make(std::make_shared<DiscChecker>(DeliveryRobot(), std::vector{kDiscAhead}));
  EXPECT_FALSE(si->isValid(MakeState(si->getStateSpace(), {-10.5, 0, 0}).get()));
}

TEST(SceneValidityChecker, ClearanceUpToItsLimit) {
  PlanningOptions options;
  options.clearance_up_to_m = 2;
  const auto si =
      Make(std::make_shared<DiscChecker>(DeliveryRobot(), std::vector{kDiscAhead}), options);
  const auto& dut = *si->getStateValidityChecker();
  double clearance_m = -1;
  EXPECT_TRUE(dut.isValid(MakeState(si->getStateSpace(), {0.5, 0, 0}).get(), clearance_m));
  EXPECT_NEAR(clearance_m, 1.0, 1e-12);
  EXPECT_NEAR(dut.clearance(MakeState(si->getStateSpace(), {-5, 0, 0}).get()), 2.0, 1e-12);
  EXPECT_FALSE(dut.isValid(MakeState(si->getStateSpace(), {3, 0, 0}).get(), clearance_m));
  EXPECT_EQ(clearance_m, 0);
}

TEST(SceneValidityChecker, AnErrorIsInvalidAndRemembered) {
  const auto si = Make(std::make_shared<FailingChecker>(absl::UnavailableError("gone")));
  const auto state = MakeState(si->getStateSpace(), {0, 0, 0});
  double clearance_m = -1;
  EXPECT_FALSE(si->isValid(state.get()));
  EXPECT_FALSE(si->getStateValidityChecker()->isValid(state.get(), clearance_m));
  EXPECT_EQ(clearance_m, 0);
  EXPECT_FALSE(si->checkMotion(state.get(), state.get()));
  EXPECT_EQ(QueryOf(*si)->error_count(), 3);
  EXPECT_EQ(QueryOf(*si)->first_error(), absl::UnavailableError("gone"));
}

TEST(SceneValidityChecker, ManyThreadsGetTheSameAnswers) {
  const auto si = Make(std::make_shared<DiscChecker>(DeliveryRobot(), std::vector{kDiscAhead}));
  std::atomic<int> valid_states = 0, valid_motions = 0;
  const auto run = [&] {
    const auto a = MakeState(si->getStateSpace(), {0, 0, 0});
    const auto b = MakeState(si->getStateSpace(), {1, 0, 0});
    const auto c = MakeState(si->getStateSpace(), {2, 0, 0});
    for (int i = 0; i < 200; ++i) {
      valid_states += si->isValid(a.get()) + si->isValid(c.get());
      valid_motions += si->checkMotion(a.get(), b.get()) + si->checkMotion(b.get(), c.get());
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back(run);
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(valid_states, 800);
  EXPECT_EQ(valid_motions, 800);
  EXPECT_EQ(si->getMotionValidator()->getValidMotionCount(), 800u);
  EXPECT_EQ(si->getMotionValidator()->getInvalidMotionCount(), 800u);
}

TEST(MakeSpaceInformation, RefusesWhatDoesNotFit) {
  const auto checker = std::make_shared<DiscChecker>(DeliveryRobot(), std::vector{kDiscAhead});
  EXPECT_FALSE(MakeSpaceInformation(nullptr, checker, Mapping(), {}).ok());
  EXPECT_FALSE(MakeSpaceInformation(MakeSe2(), nullptr, Mapping(), {}).ok());
  EXPECT_FALSE(MakeSpaceInformation(MakeSe3(), checker, Mapping(), {}).ok());
  PlanningOptions options;
  options.step_m = -1;
  EXPECT_FALSE(MakeSpaceInformation(MakeSe2(), checker, Mapping(), options).ok());
  const auto unbounded = std::make_shared<ob::SE2StateSpace>();
  EXPECT_FALSE(MakeSpaceInformation(unbounded, checker, Mapping(), {}).ok());
}

}  // namespace
}  // namespace clearway
