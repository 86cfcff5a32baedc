// Objects that were lost and could be the one that is seen again, so that nobody is.
#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

constexpr double kPeriod_s = 0.1;
const std::vector<Eigen::Vector3d> kPedestrian = BoxSurface({0.5, 0.5, 1.75}, 0.06);

// A pedestrian's way along x, as far as it is seen: by which id, and from which frame up to which.
struct Sight {
  ObjectId id;
  int from, until;
};
struct Walk {
  double start_m, speed_mps;
  std::vector<Sight> sights;
  // Behind the wall all speed up by so much.
  double faster_mps = 0;

  double At_m(int k) const {
    constexpr int kFaster = 40;
    const int after = std::max(0, k - kFaster);
    return start_m + kPeriod_s * (speed_mps * k + faster_mps * after);
  }
};

class Rivals : public testing::Test {
 protected:
  Rivals() {
    params_.motion = MotionModel::kTrack;
    params_.reidentify = true;
  }
  void See(const std::vector<Walk>& walks, int frames) {
    dut_.emplace(params_, FrameLimits{}, pool_);
    joined_ = 0;
    for (int k = 0; k < frames; ++k) {
      Frame frame = FrameAt(k * kPeriod_s);
      for (const Walk& walk : walks) Add(walk, k, frame);
      const auto report = dut_->Apply(frame);
      ASSERT_TRUE(report.ok()) << report.status();
      joined_ += report->objects_reidentified;
    }
  }
  bool Same(ObjectId a, ObjectId b) {
    const ScenePtr scene = dut_->Publish();
    return scene->FindObject(a) != nullptr && scene->FindObject(a) == scene->FindObject(b);
  }

  ThreadPool pool_{1};
  SceneParams params_;
  std::optional<SceneBuilder> dut_;
  std::size_t joined_ = 0;

 private:
  static void Add(const Walk& walk, int k, Frame& frame) {
    for (const Sight& sight : walk.sights) {
      if (k < sight.from || k >= sight.until) continue;
      AddObject(frame, sight.id, Pose::Translation(walk.At_m(k), 0, 0), kPedestrian);
      if (k == sight.from) continue;
      const Pose H_W = Pose::Translation(walk.At_m(k) - walk.At_m(k - 1), 0, 0);
      frame.motions.push_back({sight.id, H_W, At((k - 1) * kPeriod_s)});
    }
  }
};

// Without a rival the second would be known again: this is what the tests below tell.
TEST_F(Rivals, NoneOfOneWhoIsAlone) {
  See({{0, 1.5, {{2, 0, 25}, {12, 74, 90}}}}, 90);
  EXPECT_TRUE(Same(2, 12));
}

// The leader, hidden for 5.4 s, comes back where the follower behind it could be.
TEST_F(Rivals, AreThereBeyondTheHorizon) {
  for (const double gap_m : {0.65, 0.75, 0.85}) {
    See({{gap_m, 1.5, {{1, 0, 20}, {11, 74, 90}}}, {0, 1.5, {{2, 0, 25}, {12, 79, 90}}}}, 90);
    EXPECT_EQ(joined_, 0u) << gap_m;
  }
}

// Of the tracks no more is left than their end: not where they were first seen.
TEST_F(Rivals, AreThereThoughTheirHistoryIsShort) {
  params_.history = std::chrono::milliseconds(300);
  See({{0, 1.5, {{2, 0, 25}, {12, 60, 80}}}}, 80);
  EXPECT_TRUE(Same(2, 12));
  See({{0.75, 1.5, {{1, 0, 20}, {11, 74, 90}}}, {0, 1.5, {{2, 0, 25}, {12, 79, 90}}}}, 90);
  EXPECT_EQ(joined_, 0u);
}

// The leader comes back just before it would have been dropped.
TEST_F(Rivals, AreThereThoughTheyWereDroppedMeanwhile) {
  params_.object_lifetime = std::chrono::seconds(3);
  See({{0.75, 1.5, {{1, 0, 20}, {11, 48, 62}}}, {0, 1.5, {{2, 0, 25}}}}, 62);
  EXPECT_EQ(joined_, 0u);
}

// Who was seen once has no velocity, and may have the other's.
TEST_F(Rivals, AreThereThoughTheirWayIsNotKnown) {
  See({{0.75, 1.5, {{1, 24, 25}, {11, 60, 80}}}, {0, 1.5, {{2, 0, 25}}}}, 80);
  EXPECT_EQ(joined_, 0u);
}

// Who was seen once, 6 s ago, may be anywhere, while this one is just where it was to be.
TEST_F(Rivals, AreNotThereByAStrangeChance) {
  See({{0.75, 1.5, {{1, 0, 1}}}, {0, 1.5, {{2, 0, 55}, {12, 61, 80}}}}, 80);
  EXPECT_TRUE(Same(2, 12));
}

// 1 might have gone on at the speed of 12, but would be 3 m from where it was to be, or 4 m.
TEST_F(Rivals, AreThereUnlessTheyAreFarFromWhereTheyWereToBe) {
  See({{0.7, 1, {{1, 0, 10}}}, {0, 1.5, {{2, 0, 25}, {12, 74, 90}}}}, 90);
  EXPECT_FALSE(Same(2, 12));
  See({{-0.3, 1, {{1, 0, 10}}}, {0, 1.5, {{2, 0, 25}, {12, 74, 90}}}}, 90);
  EXPECT_TRUE(Same(2, 12));
}

// Both go faster where nobody sees them: the follower is where the leader was to be.
TEST_F(Rivals, AreThereThoughTheyWentFaster) {
  const Walk leader{1.8, 3, {{1, 0, 40}, {11, 64, 80}}, 0.8};
  const Walk follower{0, 3, {{2, 0, 40}, {12, 64, 80}}, 0.8};
  See({leader, follower}, 80);
  EXPECT_EQ(joined_, 0u);
}

// 2 can be nobody but 1, from whom it was too long out of sight to tell; 3 is known again as 2.
TEST_F(Rivals, AreNotTheSameOneAsItWasBefore) {
  See({{0, 1.5, {{1, 0, 20}, {2, 75, 90}, {3, 100, 115}}}}, 115);
  EXPECT_FALSE(Same(1, 2));
  EXPECT_TRUE(Same(2, 3));
}

// Nobody is known by a glimpse: of a whole file one in the middle is seen for 0.4 s, and the one
// ahead, whom nobody saw, comes out first.
TEST_F(Rivals, NeedNotBeKnownOfOneWhoWasGlimpsed) {
  See({{0.3, 1.5, {{11, 60, 80}}}, {0, 1.5, {{2, 20, 24}}}}, 80);
  EXPECT_EQ(joined_, 0u);
}

// 1 and 3 are one; in between it is seen as 2 for a moment, too briefly to be known by.
TEST_F(Rivals, AreNotSightsOfTheLostOneInBetween) {
  See({{0, 1.5, {{1, 0, 25}, {2, 35, 36}, {3, 50, 65}, {4, 75, 90}}}}, 90);
  EXPECT_TRUE(Same(1, 3));
  EXPECT_TRUE(Same(1, 4));
}

TEST_F(Rivals, AreNotThoseWhoGoAnotherWay) {
  See({{0, 1.5, {{2, 0, 25}, {12, 60, 80}}}, {9, -1.5, {{1, 0, 25}, {11, 60, 80}}}}, 80);
  EXPECT_TRUE(Same(2, 12));
  EXPECT_TRUE(Same(1, 11));
}

}  // namespace
}  // namespace clearway
