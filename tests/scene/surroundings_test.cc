// Nobody is known again as one that what lies behind would be seen through.
#include <gtest/gtest.h>

#include <utility>

#include "scene/seen_through.h"

namespace clearway {
namespace {

TEST_F(SeenThrough, IsNotTheOneThatWasLost) {
  LoseAndSee(kCyclist, kPedestrian);
  EXPECT_FALSE(Same(1, 2));
}

TEST_F(SeenThrough, IsNotTheOneThatWasLostIfASourceMissesIt) {
  missed_ = 40;
  LoseAndSee(kCyclist, kPedestrian);
  EXPECT_FALSE(Same(1, 2));
}

// Be it at once (masks of a camera, with points of their own) or between its frames.
TEST_F(SeenThrough, IsNotTheOneThatWasLostByWhatAnotherSensorSees) {
  using Times = std::pair<double, double>;
  for (const auto& [period_s, later_s] : {Times{0.1, 0}, {0.1, 0.05}, {0.2, 0.15}}) {
    BeginAnew();
    period_s_ = period_s;
    background_s_ = later_s;
    LoseAndSee(kCyclist, kPedestrian);
    EXPECT_FALSE(Same(1, 2)) << later_s;
  }
}

TEST_F(SeenThrough, IsNotTheOneThatWasLostWhenItIsGone) {
  for (const int frames : {5, 12}) {
    BeginAnew();
    See(1, kCyclist, 0, 20);
    See(2, kPedestrian, 30, 30 + frames);
    SeeNobody(30 + frames, 55);
    EXPECT_FALSE(Same(1, 2)) << frames;
  }
}

TEST_F(SeenThrough, IsNotTheOneThatWasLostWhenNothingLiesBehindAnyMore) {
  sky_from_ = 36;
  LoseAndSee(kCyclist, kPedestrian);
  EXPECT_FALSE(Same(1, 2));
}

TEST_F(SeenThrough, IsNobodyWhoIsThere) {
  LoseAndSee(kCyclist, kCyclist);
  EXPECT_TRUE(Same(1, 2));
}

// Its front is still behind the wall.
TEST_F(SeenThrough, IsNobodyOfWhomThereIsNoRay) {
  See(1, kCyclist, 0, 20);
  wall_from_m_ = 0;
  See(2, kCyclist, 30, 50);
  EXPECT_TRUE(Same(1, 2));
}

// It may be half a width off, and a tenth of its way. What is seen, of a side without its ends,
// fits there, too; but what is seen around it tells that it is farther off.
TEST_F(SeenThrough, IsNobodyWhoWasToBeElsewhere) {
  for (const double ahead_m : {0.0, 0.5}) {
    BeginAnew();
    unseen_faces_.clear();
    wall_from_m_.reset();
    ahead_m_ = 0;
    See(1, kBox, 0, 20);
    unseen_faces_ = {{1, 0, 0}, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    wall_from_m_ = 0.7;
    ahead_m_ = ahead_m;
    See(2, kBox, 30, 50);
    EXPECT_EQ(Same(1, 2), ahead_m == 0) << ahead_m;
  }
}

// Where nothing lies behind, nothing tells a pedestrian from the cyclist's middle.
TEST_F(SeenThrough, IsNobodyBeforeTheOpenSky) {
  sky_from_ = 0;
  LoseAndSee(kCyclist, kPedestrian);
  EXPECT_TRUE(Same(1, 2));
}

// What is kept of them takes memory, too.
TEST_F(SeenThrough, CountsToTheBlocksThatAreAllowed) {
  LoseAndSee(kCyclist, kPedestrian);
  FrameLimits limits;
  limits.max_blocks = BlocksOfScene();
  BeginAnew(limits);
  LoseAndSee(kCyclist, kPedestrian);
  EXPECT_TRUE(absl::IsResourceExhausted(Refused()));

  params_.reidentify = false;
  BeginAnew(limits);
  LoseAndSee(kCyclist, kPedestrian);
  EXPECT_TRUE(Refused().ok());
}

// And so does what was dropped, for a while: a new one could be it.
TEST(DroppedObjects, CountToTheBlocksThatAreAllowed) {
  SceneParams params;
  params.object_lifetime = std::chrono::seconds(1);
  FrameLimits limits;
  const auto apply = [&](ThreadPool& pool) {
    SceneBuilder dut(params, limits, pool);
    const auto see = [&](ObjectId id, double t_s) {
      Frame frame = testing_support::FrameAt(t_s);
      for (int i = 0; i < 9; ++i) testing_support::AddPoint(frame, id, {5, 1.0 * i, 0});
      return dut.Apply(frame).status();
    };
    EXPECT_TRUE(see(1, 1).ok());
    const absl::Status status = see(2, 2.5);
    EXPECT_EQ(dut.Publish()->FindObject(1) == nullptr, status.ok());
    if (status.ok()) limits.max_blocks = dut.Publish()->static_map_W.blocks().size() + 12;
    return status;
  };
  ThreadPool pool(1);
  EXPECT_TRUE(apply(pool).ok());
  EXPECT_TRUE(apply(pool).ok());
  params.reidentify = true;
  EXPECT_TRUE(absl::IsResourceExhausted(apply(pool)));
}

}  // namespace
}  // namespace clearway
