// Objects that go by several ids, through the scene that makes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "clearway/scene/scene_delta.h"
#include "scene/other_ids_scene.h"

namespace clearway {
namespace {

using testing::ElementsAre;
using testing_support::AddObject;
using testing_support::AddPoint;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

TEST_F(OtherIds, NameAnObjectThatIsKnownAgain) {
  LoseAndSeeAgain();
  ASSERT_EQ(scene().objects.size(), 1u);
  const MovingObject& object = *scene().objects[0];
  EXPECT_EQ(object.id, 5);
  EXPECT_THAT(object.also, ElementsAre(9));
  EXPECT_EQ(scene().FindObject(9), &object);
  EXPECT_EQ(scene().FindObject(5), &object);
  EXPECT_EQ(scene().FindObject(6), nullptr);
  EXPECT_EQ(reidentified_, 1u);
  EXPECT_EQ(dropped_, 0u);
  EXPECT_EQ(object.first_seen, At(0));
  EXPECT_EQ(object.frames_seen, 30);
}

TEST_F(OtherIds, CarryTheObjectOnAsItsFirstDoes) {
  LoseAndSeeAgain();
  SeeFor(9, 4.5, 5);
  Frame frame = FrameAt(5);
  See(frame, 5, 5, false);
  Apply(frame);
  ASSERT_EQ(scene().objects.size(), 1u);
  const MovingObject& object = *scene().objects[0];
  EXPECT_EQ(object.t_k(), At(5));
  EXPECT_EQ(object.last_seen, At(5));
  EXPECT_EQ(created_, 2u);
  // One surface, not two.
  const Eigen::Vector3d size_m = object.observed_box_O.max - object.observed_box_O.min;
  EXPECT_LT(size_m.x(), 4.4);
  EXPECT_LT(size_m.y(), 2.2);
}

TEST_F(OtherIds, AreNoneUnlessAskedFor) {
  params_.reidentify = false;
  SetUp();
  LoseAndSeeAgain();
  EXPECT_EQ(scene().objects.size(), 2u);
  EXPECT_NE(scene().FindObject(9), scene().FindObject(5));
}

TEST_F(OtherIds, PartWhenBothAreSeenAtOnce) {
  LoseAndSeeAgain();
  Frame frame = FrameAt(4.5);
  See(frame, 5, 4.5, false, 30);
  See(frame, 9, 4.5, false);
  Apply(frame);
  ASSERT_EQ(scene().objects.size(), 2u);
  EXPECT_EQ(dropped_, 1u);
  EXPECT_EQ(created_, 4u);
  for (const ObjectId id : {5, 9}) {
    const MovingObject& object = *scene().FindObject(id);
    EXPECT_EQ(object.id, id);
    EXPECT_TRUE(object.also.empty());
    EXPECT_EQ(object.first_seen, At(4.5));
  }
  // They stay two.
  for (double t = 4.6; t < 5.5; t += kPeriod_s) {
    frame = FrameAt(t);
    See(frame, 5, t, false, 30);
    See(frame, 9, t, false);
    Apply(frame);
  }
  EXPECT_EQ(scene().objects.size(), 2u);
}

// A motion of the other id alone, beside points, is of a track that the source has given up.
TEST_F(OtherIds, FollowTheOneThatIsSeen) {
  LoseAndSeeAgain();
  Frame frame = FrameAt(4.5);
  frame.motions.push_back({5, Pose::Translation(3, 3, 0), At(4.4)});
  See(frame, 9, 4.5, false);
  Apply(frame);
  ASSERT_EQ(scene().objects.size(), 1u);
  const Eigen::Vector3d moved =
      scene().objects[0]->history.back().T_W_O.translation -
      versions_[versions_.size() - 2]->objects[0]->history.back().T_W_O.translation;
  EXPECT_LT((moved - Eigen::Vector3d(0.8, 0, 0)).norm(), 1e-6);
}

TEST_F(OtherIds, AreNotTakenFromOneOfTwoThatItCouldBe) {
  SeeTwo(0.6);
  for (double t = 3.5; t < 4.5; t += kPeriod_s) {
    Frame frame = FrameAt(t);
    See(frame, 9, t, t == 3.5, 0.3);
    Apply(frame);
  }
  EXPECT_EQ(scene().objects.size(), 3u);
  EXPECT_EQ(reidentified_, 0u);
}

// 9 could be 5 or 6, and 10 could be 5; that 9 is no longer young does not make 10 be 5.
TEST_F(OtherIds, AreNotTakenWhileAnotherCouldBeTheLostOne) {
  SeeTwo(2);
  for (int k = 35; k < 70; ++k) {
    const double t = k * kPeriod_s;
    Frame frame = FrameAt(t);
    See(frame, 9, t, k == 35, 1);
    if (k >= 38) See(frame, 10, t, k == 38, -1);
    Apply(frame);
  }
  EXPECT_EQ(scene().objects.size(), 4u);
  EXPECT_EQ(reidentified_, 0u);
}

// A source that tells where an unseen object is has not lost it.
TEST_F(OtherIds, AreNotTakenWhileTheSourceFollowsTheFirst) {
  SeeFor(5, 0, 2);
  for (double t = 2; t < 4.5; t += kPeriod_s) {
    Frame frame = FrameAt(t);
    frame.motions.push_back({5, Pose::Translation(0.8, 0, 0), At(t - kPeriod_s)});
    if (t > 3.45) See(frame, 9, t, t < 3.55);
    Apply(frame);
  }
  EXPECT_EQ(scene().objects.size(), 2u);
}

// 9 could be 5 or 6; 11 can only be 9.
TEST_F(OtherIds, OfAChainOfThreeAreNotLost) {
  for (const auto& [second, third] : {std::pair(9, 11), {20, 10}}) {
    SetUp();
    const auto see = [&](int from, int until, auto&& add) {
      for (int k = from; k < until; ++k) {
        Frame frame = FrameAt(k * kPeriod_s);
        add(frame, k * kPeriod_s, k == from);
        Apply(frame);
      }
    };
    see(0, 20, [&](Frame& frame, double t, bool first) {
      See(frame, 5, t, first);
      See(frame, 6, t, first, 0.6);
    });
    see(64, 68, [&](Frame& frame, double t, bool first) { See(frame, second, t, first, 0.3); });
    see(68, 72, [](Frame&, double, bool) {});
    see(72, 76, [&](Frame& frame, double t, bool first) { See(frame, third, t, first, 0.3); });
    see(76, 78, [](Frame&, double, bool) {});
    // Now 9 can only be 5, in the frame in which 11 is found to be 9.
    see(78, 100, [&](Frame& frame, double t, bool first) { See(frame, 6, t, first, 30); });
    for (const ObjectId id : {5, 6, second, third})
      EXPECT_NE(scene().FindObject(id), nullptr) << id;
    EXPECT_NE(scene().FindObject(5), scene().FindObject(6));
  }
}

// After the lifetime of objects an id may be another object's, as it may without this.
TEST_F(OtherIds, LapseWhenTheyWereNotToldForLong) {
  LoseAndSeeAgain();
  SeeFor(12, 6, 20);
  ASSERT_THAT(scene().FindObject(12)->also, ElementsAre(9, 12));
  SeeWithAnother(12, 9, 20);
  ASSERT_EQ(scene().objects.size(), 2u);
  EXPECT_EQ(dropped_, 0u);
  const MovingObject &first = *scene().FindObject(12), &other = *scene().FindObject(9);
  EXPECT_EQ(first.id, 5);
  EXPECT_EQ(first.first_seen, At(0));
  EXPECT_THAT(first.also, ElementsAre(12));
  EXPECT_EQ(other.first_seen, At(20));
  EXPECT_LT(other.observed_box_O.Size().norm(), 6);
  EXPECT_EQ(scene().FindObject(5), &first);
}

// Of a chain the first does, though the second was told not long ago.
TEST_F(OtherIds, LapseOneByOne) {
  SeeFor(5, 0, 2);
  SeeFor(9, 3.5, 18);
  SeeFor(12, 19.5, 21);
  ASSERT_THAT(scene().FindObject(5)->also, ElementsAre(9, 12));
  SeeWithAnother(12, 5, 21);
  ASSERT_EQ(scene().objects.size(), 2u);
  EXPECT_EQ(dropped_, 0u);
  EXPECT_EQ(scene().FindObject(9)->id, 9);
  EXPECT_EQ(scene().FindObject(9)->first_seen, At(0));
  EXPECT_THAT(scene().FindObject(9)->also, ElementsAre(12));
  EXPECT_EQ(scene().FindObject(5)->first_seen, At(21));
  EXPECT_LT(scene().FindObject(5)->observed_box_O.Size().norm(), 6);
}

TEST_F(OtherIds, DoNotLapseWhileTheyAreTold) {
  LoseAndSeeAgain();
  SeeFor(5, 4.5, 20);
  SeeFor(9, 20, 21);
  ASSERT_EQ(scene().objects.size(), 1u);
  EXPECT_THAT(scene().objects[0]->also, ElementsAre(9));
}

// A wrong label or two.
TEST_F(OtherIds, DoNotPartForAStrayPoint) {
  LoseAndSeeAgain();
  Frame frame = FrameAt(4.5);
  See(frame, 9, 4.5, false);
  AddPoint(frame, 5, {20, 20, 0});
  Apply(frame);
  ASSERT_EQ(scene().objects.size(), 1u);
  EXPECT_EQ(dropped_, 0u);
  EXPECT_LT(scene().objects[0]->observed_box_O.Size().norm(), 6);
}

// Of another sensor, which does not see the object.
TEST_F(OtherIds, WaitAsLongWhateverFramesComeBetween) {
  SeeFor(5, 0, 2);
  double joined_s = 0;
  for (int k = 0; k < 10; ++k) {
    const double t = 3.5 + k * kPeriod_s;
    Frame frame = FrameAt(t);
    See(frame, 9, t, k == 0);
    Apply(frame);
    Apply(FrameAt(t + 0.05));
    if (reidentified_ > 0 && joined_s == 0) joined_s = t;
  }
  EXPECT_NEAR(joined_s, 4.1, 0.05);
}

TEST_F(OtherIds, TakeTheirStatedFutureAlong) {
  SeeFor(5, 0, 2);
  SeeFor(9, 3.5, 3.9);
  const Pose stop = scene().FindObject(9)->history.back().T_W_O;
  ASSERT_TRUE(dut_->SetFuture(9, {{At(5), stop}, {At(6), stop}}).ok());
  Frame frame = FrameAt(3.9);
  for (double t = 3.9; t < 4.3; t += kPeriod_s) {
    frame = FrameAt(t);
    See(frame, 9, t, false);
    Apply(frame);
  }
  ASSERT_EQ(reidentified_, 1u);
  const MovingObject& object = *scene().FindObject(9);
  EXPECT_EQ(object.id, 5);
  ASSERT_EQ(object.future.size(), 2u);
  const Pose T_W_O = PredictPose(object, At(6), params_.horizon).T_W_O;
  EXPECT_LT((T_W_O.translation - Driving(3.8).translation).norm(), 0.3);
  EXPECT_EQ(object.LastVelocity(), Twist{});
}

TEST_F(OtherIds, AreNamedWhenAPoseIsTooFar) {
  FrameLimits limits;
  limits.max_coordinate_m = 100;
  dut_.emplace(params_, limits, pool_);
  LoseAndSeeAgain();
  Frame frame = FrameAt(4.5);
  frame.poses.push_back({9, Pose()});
  Apply(frame);
  frame = FrameAt(4.6);
  frame.poses.push_back({9, Pose::Translation(90, 0, 0)});
  const auto report = dut_->Apply(frame);
  ASSERT_TRUE(report.ok()) << report.status();
  ASSERT_EQ(report->issues.size(), 1u);
  EXPECT_EQ(report->issues[0].kind, ObjectIssueKind::kMotionTooFar);
  EXPECT_EQ(report->issues[0].id, 9);
}

TEST_F(OtherIds, TravelWithDifferences) {
  LoseAndSeeAgain();
  Frame frame = FrameAt(4.5);
  See(frame, 5, 4.5, false, 30);
  See(frame, 9, 4.5, false);
  Apply(frame);
  for (std::size_t a = 0; a < versions_.size(); ++a) {
    for (const std::size_t b : {a + 1, versions_.size() - 2, versions_.size() - 1}) {
      if (b <= a || b >= versions_.size()) continue;
      const auto applied =
          clearway::Apply(versions_[a].get(), Diff(versions_[a].get(), *versions_[b]));
      ASSERT_TRUE(applied.ok()) << applied.status();
      EXPECT_TRUE(SameContent(*applied, *versions_[b])) << a << " " << b;
      EXPECT_EQ(applied->Hash(), versions_[b]->Hash());
    }
  }
}

TEST_F(OtherIds, AreRefusedToGivenObjectsAndTakenForFutures) {
  LoseAndSeeAgain();
  GivenObject given;
  given.id = 9;
  given.shape = Box{{1, 1, 1}};
  EXPECT_EQ(dut_->AddObject(given).code(), absl::StatusCode::kAlreadyExists);
  EXPECT_TRUE(dut_->SetFuture(9, {{At(6), Driving(6)}}).ok());
  EXPECT_EQ(dut_->Publish()->FindObject(5)->future.size(), 1u);
}

TEST_F(OtherIds, OfADifferenceAreIdsOfObjects) {
  LoseAndSeeAgain();
  SceneDelta delta = Diff(nullptr, scene());
  delta.objects[0].also = {-1};
  const auto applied = clearway::Apply(nullptr, delta);
  EXPECT_EQ(applied.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(applied.status().message()),
              testing::HasSubstr("objects[id=5].other_ids"));
  delta.objects[0].also = {9, 12};
  EXPECT_THAT(std::string(clearway::Apply(nullptr, delta).status().message()),
              testing::HasSubstr("objects[id=5].older_ids_told_ns: has 1 stamps for 2 other_ids"));
}

}  // namespace
}  // namespace clearway
