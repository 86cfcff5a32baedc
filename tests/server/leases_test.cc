#include "server/leases.h"

#include <gtest/gtest.h>

#include <future>

#include "wire/status.h"

namespace clearway {
namespace {

using std::chrono::seconds;

class HeldScenes : public testing::Test {
 protected:
  // Frees itself slowly: before it is gone, another thread must get an answer from the leases.
  ScenePtr SceneThatNeedsTheLeases() {
    return {new SceneSnapshot, [this](const SceneSnapshot* scene) {
              auto other = std::async(std::launch::async, [this] { return dut_.size(); });
              freed_unlocked_ = other.wait_for(seconds(20)) == std::future_status::ready;
              delete scene;
            }};
  }

  Leases::Clock::time_point now_ = Leases::Clock::now();
  bool freed_unlocked_ = false;
  Leases dut_{{.max_leases = 2, .max_ttl = seconds(60), .now = [this] { return now_; }}};
};

TEST_F(HeldScenes, Empty) {
  EXPECT_EQ(dut_.size(), 0u);
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.Find("none").status()));
}

TEST_F(HeldScenes, EndsWithItsTimeToLive) {
  const auto lease = dut_.Acquire(std::make_shared<SceneSnapshot>(), seconds(5), "planner");
  ASSERT_TRUE(lease.ok());
  now_ += seconds(4);
  EXPECT_TRUE(dut_.Find(lease->id).ok());
  EXPECT_TRUE(dut_.Renew(lease->id, seconds(5)).ok());
  now_ += seconds(4);
  EXPECT_TRUE(dut_.Find(lease->id).ok());
  now_ += seconds(2);
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.Find(lease->id).status()));
  EXPECT_EQ(dut_.size(), 0u);
}

TEST_F(HeldScenes, NobodyWaitsWhileAScenesMemoryIsFreed) {
  const auto lease = dut_.Acquire(SceneThatNeedsTheLeases(), seconds(5), "planner");
  ASSERT_TRUE(lease.ok());
  dut_.Release(lease->id);
  EXPECT_TRUE(freed_unlocked_);
  freed_unlocked_ = false;
  ASSERT_TRUE(dut_.Acquire(SceneThatNeedsTheLeases(), seconds(5), "planner").ok());
  now_ += seconds(6);
  EXPECT_EQ(dut_.size(), 0u);
  EXPECT_TRUE(freed_unlocked_);
}

TEST(LeasesOfPeers, NoneKeepsTheOthersOut) {
  Leases dut({.max_leases = 3, .max_of_peer = 2});
  const auto acquire = [&](const std::string& peer) {
    return dut.Acquire(std::make_shared<SceneSnapshot>(), seconds(50), peer);
  };
  ASSERT_TRUE(acquire("a").ok());
  const auto second = acquire("a");
  ASSERT_TRUE(second.ok());
  EXPECT_TRUE(absl::IsResourceExhausted(acquire("a").status()));
  EXPECT_TRUE(acquire("b").ok());
  EXPECT_TRUE(absl::IsResourceExhausted(acquire("c").status()));
  dut.Release(second->id);
  EXPECT_TRUE(acquire("c").ok());
}

class LeasesTest : public testing::Test {
 protected:
  ScenePtr Scene() {
    SceneSnapshot scene = SceneSnapshot::Empty({});
    scene.version = 5;
    return std::make_shared<const SceneSnapshot>(scene);
  }
  Leases::Clock::time_point now_;
  Leases dut_{
      {.max_leases = 2, .max_ttl = std::chrono::seconds(60), .now = [this] { return now_; }}};
};

TEST_F(LeasesTest, Empty) {
  EXPECT_EQ(dut_.size(), 0u);
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.Find("x").status()));
}

TEST_F(LeasesTest, HoldsAVersionUntilItsTimeIsOver) {
  const auto lease = dut_.Acquire(Scene(), std::chrono::seconds(10), "planner");
  ASSERT_TRUE(lease.ok());
  now_ += std::chrono::seconds(9);
  EXPECT_EQ((*dut_.Find(lease->id))->version, 5u);
  now_ += std::chrono::seconds(1);
  const absl::Status gone = dut_.Find(lease->id).status();
  EXPECT_TRUE(absl::IsFailedPrecondition(gone));
  EXPECT_EQ(ReasonOf(gone), "LEASE_GONE");
  EXPECT_TRUE(absl::IsFailedPrecondition(dut_.Renew(lease->id, std::chrono::seconds(9)).status()));
}

TEST_F(LeasesTest, RenewalCountsFromNow) {
  const auto lease = dut_.Acquire(Scene(), std::chrono::seconds(10), "planner");
  now_ += std::chrono::seconds(9);
  ASSERT_TRUE(dut_.Renew(lease->id, std::chrono::seconds(10)).ok());
  now_ += std::chrono::seconds(9);
  EXPECT_TRUE(dut_.Find(lease->id).ok());
}

TEST_F(LeasesTest, IsGrantedAtMostTheLongestTime) {
  EXPECT_EQ(dut_.Acquire(Scene(), std::chrono::hours(1), "planner")->ttl, std::chrono::seconds(60));
}

TEST_F(LeasesTest, RefusesMoreThanAllowedUntilOneEnds) {
  const auto first = dut_.Acquire(Scene(), std::chrono::seconds(10), "planner");
  ASSERT_TRUE(dut_.Acquire(Scene(), std::chrono::seconds(10), "planner").ok());
  EXPECT_TRUE(absl::IsResourceExhausted(
      dut_.Acquire(Scene(), std::chrono::seconds(10), "planner").status()));
  dut_.Release(first->id);
  EXPECT_TRUE(dut_.Acquire(Scene(), std::chrono::seconds(10), "planner").ok());
}

TEST_F(LeasesTest, TheVersionIsFreedWithTheLease) {
  ScenePtr scene = Scene();
  const std::weak_ptr<const SceneSnapshot> watch = scene;
  const auto lease = dut_.Acquire(std::move(scene), std::chrono::seconds(10), "planner");
  EXPECT_FALSE(watch.expired());
  dut_.Release(lease->id);
  EXPECT_TRUE(watch.expired());
}

}  // namespace
}  // namespace clearway
