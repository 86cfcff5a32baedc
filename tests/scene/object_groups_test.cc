// Objects of several rigid parts, through the scene that makes them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "clearway/scene/scene_delta.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

constexpr ObjectId kTractor = 1, kTrailer = 2;
constexpr double kPeriod_s = 0.1, kSpeed_mps = 5, kTurn_radps = 0.5;
const std::vector<Eigen::Vector3d> kBody = BoxSurface({3, 2, 2}, 0.2);

Pose TurnedBy(double yaw_rad) { return Exp({{0, 0, yaw_rad}, Eigen::Vector3d::Zero()}); }
Pose Swung(double pitch_rad) { return Exp({{0, pitch_rad, 0}, Eigen::Vector3d::Zero()}); }

// A tractor that goes in a circle, and its trailer, at a constant angle behind it.
Pose TractorAt(double t) {
  return TurnedBy(kTurn_radps * t) * Pose::Translation(kSpeed_mps / kTurn_radps, 0, 0) *
         TurnedBy(M_PI / 2);
}
Pose TrailerAt(double t) {
  return TractorAt(t) * Pose::Translation(-1.7, 0, 0) * TurnedBy(-0.3) *
         Pose::Translation(-1.7, 0, 0);
}

double Apart_m(const Pose& a, const Pose& b) { return (a.translation - b.translation).norm(); }

class ObjectGroups : public testing::Test {
 protected:
  using Place = Pose (*)(double);

  void SetUp() override { dut_.emplace(params_, FrameLimits{}, pool_); }

  static Frame TruckAt(double t) {
    Frame frame = FrameAt(t);
    frame.parts = {{kTrailer, kTractor}};
    return frame;
  }
  static void See(Frame& frame, ObjectId id, Place place) {
    AddObject(frame, id, place(ToSeconds(frame.stamp - At(0))), kBody);
  }
  static void Move(Frame& frame, ObjectId id, Place place) {
    const double t = ToSeconds(frame.stamp - At(0));
    if (t <= 0) return;
    frame.motions.push_back({id, place(t) * Inverse(place(t - kPeriod_s)), At(t - kPeriod_s)});
  }
  // Both are seen and placed from 0 s until then.
  void DriveUntil(double until_s) {
    for (double t = 0; t < until_s - 1e-9; t += kPeriod_s) {
      Frame frame = TruckAt(t);
      using Part = std::pair<ObjectId, Place>;
      for (const auto& [id, place] : {Part{kTractor, TractorAt}, Part{kTrailer, TrailerAt}}) {
        See(frame, id, place);
        Move(frame, id, place);
      }
      Apply(frame);
    }
  }
  FrameReport Apply(const Frame& frame) {
    const auto report = dut_->Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    scene_ = dut_->Publish();
    return report.value_or(FrameReport{});
  }
  const MovingObject& Object(ObjectId id) { return *scene_->FindObject(id); }
  // T_W_O now and that much later.
  Pose Predicted(ObjectId id, double at_s) {
    return PredictPose(Object(id), At(at_s), params_.horizon).T_W_O;
  }
  // How far the object's place in the tractor is, then, from where it is now.
  double Strays_m(ObjectId id, double at_s) {
    const Eigen::Vector3d now =
        (Inverse(Object(kTractor).history.back().T_W_O) * Object(id).history.back().T_W_O)
            .translation;
    const Eigen::Vector3d then =
        (Inverse(Predicted(kTractor, at_s)) * Predicted(id, at_s)).translation;
    return (then - now).norm();
  }

  ThreadPool pool_{1};
  SceneParams params_;
  std::optional<SceneBuilder> dut_;
  ScenePtr scene_;
};

TEST_F(ObjectGroups, AreNoneUnlessToldOf) {
  Frame frame = TruckAt(0);
  frame.parts.clear();
  See(frame, kTractor, TractorAt);
  See(frame, kTrailer, TrailerAt);
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kStaticLabel);
  EXPECT_TRUE(scene_->PartsOf(kTractor).empty());
}

TEST_F(ObjectGroups, HaveAMapForEachPart) {
  DriveUntil(1);
  EXPECT_EQ(Object(kTrailer).part_of, kTractor);
  EXPECT_EQ(Object(kTractor).part_of, kStaticLabel);
  ASSERT_EQ(scene_->PartsOf(kTractor).size(), 1u);
  EXPECT_EQ(scene_->PartsOf(kTractor)[0], &Object(kTrailer));
  for (const ObjectId id : {kTractor, kTrailer}) {
    const Eigen::Vector3d size_m = Object(id).observed_box_O.Size();
    EXPECT_LT(size_m.x(), 4.0);  // as long as it is wide, turned by the first sight's angle
    EXPECT_GT(Object(id).map_O.occupied_count(), 100);
  }
}

TEST_F(ObjectGroups, AreRememberedWithoutBeingToldAgain) {
  DriveUntil(1);
  Frame frame = TruckAt(1);
  frame.parts.clear();
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kTractor);
}

TEST_F(ObjectGroups, EndWhenToldSo) {
  DriveUntil(1);
  Frame frame = TruckAt(1);
  frame.parts = {{kTrailer, kStaticLabel}};
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kStaticLabel);
}

TEST_F(ObjectGroups, AreToldOfObjectsThatAreThere) {
  Frame frame = TruckAt(0);
  See(frame, kTractor, TractorAt);
  Apply(frame);
  frame = TruckAt(kPeriod_s);
  frame.parts.clear();
  See(frame, kTrailer, TrailerAt);
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).part_of, kStaticLabel);
}

TEST_F(ObjectGroups, ArePredictedAlongOneMotion) {
  DriveUntil(2);
  for (const double ahead_s : {0.5, 1.0, 3.0}) {
    const double then_s = 1.9 + ahead_s;
    EXPECT_LT(Strays_m(kTrailer, then_s), 1e-9) << ahead_s;
    // In a steady turn that is where it really comes to.
    const Pose T_B_O = Inverse(TrailerAt(1.9)) * Object(kTrailer).history.back().T_W_O;
    EXPECT_LT(Apart_m(Predicted(kTrailer, then_s), TrailerAt(then_s) * T_B_O), 1e-6);
  }
}

// The legs of a cyclist: by themselves they would fly away within a second.
TEST_F(ObjectGroups, KeepPartsThatSwingInTheirPlace) {
  const Place leg_at = [](double t) {
    return TractorAt(t) * Pose::Translation(0.3, 0, -0.2) * Swung(0.6 * std::sin(8 * t)) *
           Pose::Translation(0, 0, -0.4);
  };
  for (const bool together : {true, false}) {
    SetUp();
    for (double t = 0; t < 3; t += kPeriod_s) {
      Frame frame = FrameAt(t);
      if (together) frame.parts = {{kTrailer, kTractor}};
      See(frame, kTractor, TractorAt);
      Move(frame, kTractor, TractorAt);
      AddObject(frame, kTrailer, leg_at(t), BoxSurface({0.2, 0.2, 0.8}, 0.1));
      Move(frame, kTrailer, leg_at);
      Apply(frame);
    }
    if (together) {
      EXPECT_LT(Strays_m(kTrailer, 4), 1e-9);
    } else {
      EXPECT_GT(Strays_m(kTrailer, 4), 0.5);
    }
  }
}

// The boom of an excavator that stands: its own motion tells where it will be, its whole's does
// not.
TEST_F(ObjectGroups, LetPartsGoTheirWayThatAreBetterForeseenByIt) {
  const Place base_at = [](double) { return Pose(); };
  const Place boom_at = [](double t) { return TurnedBy(0.4 * t) * Pose::Translation(4, 0, 1); };
  for (double t = 0; t < 4; t += kPeriod_s) {
    Frame frame = TruckAt(t);
    See(frame, kTractor, base_at);
    Move(frame, kTractor, base_at);
    See(frame, kTrailer, boom_at);
    Move(frame, kTrailer, boom_at);
    Apply(frame);
    // As long as there is little to tell, it is taken to go with its whole, which may be wrong.
    if (t > 0.15 && t < 0.45) {
      EXPECT_TRUE(Object(kTrailer).AtRest()) << t;
    }
  }
  EXPECT_TRUE(Object(kTractor).AtRest());
  const Pose T_B_O = Inverse(boom_at(3.9)) * Object(kTrailer).history.back().T_W_O;
  EXPECT_LT(Apart_m(Predicted(kTrailer, 4.9), boom_at(4.9) * T_B_O), 0.01);
}

TEST_F(ObjectGroups, BoundPartsByHowTheyMissedTheirWhole) {
  DriveUntil(4);
  const double steady_m = Object(kTrailer).bound.At(1);
  SetUp();
  const Place swaying_at = [](double t) {
    return TractorAt(t) * TurnedBy(0.3 * std::sin(8 * t)) * Pose::Translation(-3.4, 0, 0);
  };
  for (double t = 0; t < 4; t += kPeriod_s) {
    Frame frame = TruckAt(t);
    See(frame, kTractor, TractorAt);
    Move(frame, kTractor, TractorAt);
    See(frame, kTrailer, swaying_at);
    Move(frame, kTrailer, swaying_at);
    Apply(frame);
  }
  EXPECT_GT(Object(kTrailer).bound.At(1), steady_m + 0.3);
}

TEST_F(ObjectGroups, CarryAlongWhatTheFrameDoesNotPlace) {
  DriveUntil(1);
  for (double t = 1; t < 2 - 1e-9; t += kPeriod_s) {
    Frame frame = TruckAt(t);
    See(frame, kTractor, TractorAt);
    Move(frame, kTractor, TractorAt);
    if (t > 1.45) See(frame, kTrailer, TrailerAt);  // hidden until then
    Apply(frame);
    EXPECT_EQ(Object(kTrailer).t_k(), frame.stamp);
    EXPECT_FALSE(Object(kTrailer).bridged);
  }
  const Pose T_B_O = Inverse(TrailerAt(0)) * Object(kTrailer).history.front().T_W_O;
  EXPECT_LT(Apart_m(Object(kTrailer).history.back().T_W_O, TrailerAt(1.9) * T_B_O), 1e-6);
  EXPECT_EQ(Object(kTrailer).frames_seen, 15);
  // What was seen then lies where it lay before.
  EXPECT_LT(Object(kTrailer).observed_box_O.Size().x(), 4.0);
}

TEST_F(ObjectGroups, AreCarriedByAnyPartThatIsPlaced) {
  DriveUntil(1);
  Frame frame = TruckAt(1);
  See(frame, kTrailer, TrailerAt);
  Move(frame, kTrailer, TrailerAt);
  Apply(frame);
  const Pose T_B_O = Inverse(TractorAt(0)) * Object(kTractor).history.front().T_W_O;
  EXPECT_LT(Apart_m(Object(kTractor).history.back().T_W_O, TractorAt(1) * T_B_O), 1e-6);
  EXPECT_LT(Strays_m(kTrailer, 3), 1e-9);
}

TEST_F(ObjectGroups, CarryPartsOverFramesThatPlacedNothing) {
  params_.history = Duration::zero();
  SetUp();
  DriveUntil(1);
  Frame frame = TruckAt(1.4);
  frame.motions = {{kTractor, TractorAt(1.4) * Inverse(TractorAt(0.9)), At(0.9)}};
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).t_k(), At(1.4));
  EXPECT_LT(Strays_m(kTrailer, 2), 1e-9);
}

TEST_F(ObjectGroups, AreKeptWhileAnyPartIsSeenAndDroppedTogether) {
  params_.object_lifetime = std::chrono::seconds(1);
  SetUp();
  DriveUntil(1);
  for (double t = 1; t < 3 - 1e-9; t += kPeriod_s) {
    Frame frame = TruckAt(t);
    See(frame, kTractor, TractorAt);
    Move(frame, kTractor, TractorAt);
    Apply(frame);
  }
  ASSERT_NE(scene_->FindObject(kTrailer), nullptr);
  EXPECT_EQ(Object(kTrailer).last_seen, At(0.9));
  EXPECT_EQ(Apply(FrameAt(3.95)).objects_dropped, 2u);
  EXPECT_TRUE(scene_->objects.empty());
}

TEST_F(ObjectGroups, LetAPartThatWasLongHiddenGoOnWhereItsWholeIs) {
  params_.horizon = std::chrono::seconds(1);
  SetUp();
  DriveUntil(1);
  // Nothing is known of either for longer than the horizon; then the source tells the tractor's
  // pose, whose box it has known from the start.
  Frame known = TruckAt(1);
  known.poses = {{kTractor, TractorAt(1)}};
  Apply(known);
  Frame frame = TruckAt(4);
  frame.poses = {{kTractor, TractorAt(4)}};
  See(frame, kTrailer, TrailerAt);
  EXPECT_EQ(Apply(frame).objects_dropped, 0u);
  const Pose T_B_O = Inverse(TrailerAt(0)) * Object(kTrailer).history.front().T_W_O;
  EXPECT_LT(Apart_m(Object(kTrailer).history.back().T_W_O, TrailerAt(4) * T_B_O), 1e-6);
  EXPECT_LT(Object(kTrailer).observed_box_O.Size().x(), 4.0);
}

TEST_F(ObjectGroups, ShareAStatedFuture) {
  DriveUntil(1);
  const Pose T_W_O = Object(kTractor).history.back().T_W_O;
  const std::vector<StampedPose> future = {{At(2), Pose::Translation(0, 0, 1) * T_W_O},
                                           {At(3), Pose::Translation(0, 0, 3) * T_W_O}};
  ASSERT_TRUE(dut_->SetFuture(kTractor, future).ok());
  scene_ = dut_->Publish();
  EXPECT_EQ(Object(kTrailer).future.size(), 2u);
  for (const double t : {1.5, 2.5, 4.0}) EXPECT_LT(Strays_m(kTrailer, t), 1e-9) << t;
  EXPECT_NEAR(Predicted(kTrailer, 3).translation.z() - Predicted(kTrailer, 0.9).translation.z(), 3,
              1e-9);
  // A frame shortens both.
  Frame frame = TruckAt(2);
  frame.motions = {{kTractor, Pose::Translation(0, 0, 1), At(0.9)}};
  Apply(frame);
  EXPECT_EQ(Object(kTractor).future.size(), 1u);
  EXPECT_EQ(Object(kTrailer).future.size(), 1u);
  for (const double t : {2.5, 4.0}) EXPECT_LT(Strays_m(kTrailer, t), 1e-9) << t;
  ASSERT_TRUE(dut_->SetFuture(kTrailer, {}).ok());
  scene_ = dut_->Publish();
  EXPECT_TRUE(Object(kTractor).future.empty());
}

TEST_F(ObjectGroups, OfGivenPartsAreRemovedTogether) {
  for (const ObjectId id : {kTractor, kTrailer, ObjectId{7}}) {
    ASSERT_TRUE(
        dut_->AddObject({id, Box{{1, 1, 1}}, {At(0), Pose::Translation(id, 0, 0)}, {}, {}}).ok());
  }
  Apply(TruckAt(0));
  EXPECT_EQ(Object(kTrailer).part_of, kTractor);
  ASSERT_TRUE(dut_->RemoveObject(kTractor).ok());
  scene_ = dut_->Publish();
  ASSERT_EQ(scene_->objects.size(), 1u);
  EXPECT_EQ(scene_->objects[0]->id, 7);
}

TEST_F(ObjectGroups, AreKeptByDifferencesAndPartOfTheHash) {
  DriveUntil(1);
  const ScenePtr before = scene_;
  Frame frame = TruckAt(1);
  frame.parts = {{kTrailer, kStaticLabel}};
  Apply(frame);
  for (const SceneSnapshot* from : {static_cast<const SceneSnapshot*>(nullptr), before.get()}) {
    const auto copy = clearway::Apply(from, Diff(from, *scene_));
    ASSERT_TRUE(copy.ok()) << copy.status();
    EXPECT_TRUE(SameContent(*copy, *scene_));
  }
  SceneSnapshot together = *scene_;
  MovingObject trailer = Object(kTrailer);
  trailer.part_of = kTractor;
  together.objects[1] = std::make_shared<const MovingObject>(trailer);
  EXPECT_FALSE(SameContent(together, *scene_));
  EXPECT_NE(together.Hash(), scene_->Hash());
}

TEST_F(ObjectGroups, OfDifferencesThatAreWrongAreRefused) {
  DriveUntil(0.1);
  for (const ObjectId whole : {ObjectId{-1}, kTrailer}) {
    SceneDelta delta = Diff(nullptr, *scene_);
    delta.objects[1].part_of = whole;
    const auto refused = clearway::Apply(nullptr, delta);
    EXPECT_EQ(refused.status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(refused.status().message(), HasSubstr("objects[id=2].part_of_id"));
  }
}

TEST_F(ObjectGroups, OfPartsThatAreWrongAreRefused) {
  const auto refused = [&](std::vector<ObjectPart> parts) {
    Frame frame = TruckAt(1);
    frame.parts = std::move(parts);
    return std::string(Validate(frame, FrameLimits{}).message());
  };
  EXPECT_THAT(refused({{0, 1}}), StartsWith("parts[0].object_id: is 0"));
  EXPECT_THAT(refused({{2, -1}}), StartsWith("parts[0].whole_id: is -1"));
  EXPECT_THAT(refused({{2, 1}, {3, 3}}), StartsWith("parts[1].whole_id: is object 3 itself"));
  EXPECT_THAT(refused({{2, 1}, {2, 3}}), StartsWith("parts[1].object_id: object 2 is told"));
  EXPECT_THAT(refused({{3, 2}, {2, 1}}),
              StartsWith("parts[0].whole_id: object 2 is itself a part, of object 1"));
  FrameLimits limits;
  limits.max_objects = 1;
  Frame frame = TruckAt(1);
  frame.parts = {{2, 1}, {3, 1}};
  EXPECT_EQ(Validate(frame, limits).code(), absl::StatusCode::kResourceExhausted);
}

TEST_F(ObjectGroups, OfPartsOfPartsAreRefused) {
  DriveUntil(0.2);
  const std::string hash = scene_->Hash();
  Frame frame = TruckAt(1);
  frame.parts = {{3, kTrailer}};
  EXPECT_THAT(std::string(dut_->Apply(frame).status().message()),
              StartsWith("parts[0].whole_id: object 2 is itself a part, of object 1"));
  frame.parts = {{kTractor, 3}};
  const absl::Status status = dut_->Apply(frame).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()),
              StartsWith("parts[0].object_id: object 1 has a part itself, object 2"));
  EXPECT_EQ(dut_->Publish()->Hash(), hash);
  frame.parts = {{kTrailer, kStaticLabel}, {kTractor, kTrailer}};  // the other way round
  EXPECT_TRUE(dut_->Apply(frame).ok());
}

TEST_F(ObjectGroups, AreNotTakenForOthersThatWereLost) {
  params_.reidentify = true;
  params_.motion = MotionModel::kTrack;
  const auto drive = [&](ObjectId id, double from_s, bool is_part) {
    for (double t = from_s; t < from_s + 1; t += kPeriod_s) {
      Frame frame = FrameAt(t);
      if (is_part) frame.parts = {{id, 50}};
      const Place straight_at = [](double s) { return Pose::Translation(8 * s, 0, 0); };
      See(frame, id, straight_at);
      if (t > from_s) Move(frame, id, straight_at);
      Apply(frame);
    }
  };
  for (const bool is_part : {false, true}) {
    SetUp();
    drive(5, 0, false);
    drive(9, 2, is_part);
    EXPECT_EQ(scene_->objects.size(), is_part ? 2u : 1u);
  }
}

}  // namespace
}  // namespace clearway
