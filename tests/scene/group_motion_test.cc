// How parts of an object go along with each other, through the scene that makes them.
#include "scene/truck_scene.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::At;
using testing_support::BoxSurface;
using testing_support::FrameAt;

class GroupMotion : public TruckScene {};

TEST_F(GroupMotion, ArePredictedAlongOneMotion) {
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
TEST_F(GroupMotion, KeepPartsThatSwingInTheirPlace) {
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
TEST_F(GroupMotion, LetPartsGoTheirWayThatAreBetterForeseenByIt) {
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

TEST_F(GroupMotion, BoundPartsByHowTheyMissedTheirWhole) {
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

TEST_F(GroupMotion, CarryAlongWhatTheFrameDoesNotPlace) {
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

TEST_F(GroupMotion, AreCarriedByAnyPartThatIsPlaced) {
  DriveUntil(1);
  Frame frame = TruckAt(1);
  See(frame, kTrailer, TrailerAt);
  Move(frame, kTrailer, TrailerAt);
  Apply(frame);
  const Pose T_B_O = Inverse(TractorAt(0)) * Object(kTractor).history.front().T_W_O;
  EXPECT_LT(Apart_m(Object(kTractor).history.back().T_W_O, TractorAt(1) * T_B_O), 1e-6);
  EXPECT_LT(Strays_m(kTrailer, 3), 1e-9);
}

TEST_F(GroupMotion, CarryPartsOverFramesThatPlacedNothing) {
  params_.history = Duration::zero();
  SetUp();
  DriveUntil(1);
  Frame frame = TruckAt(1.4);
  frame.motions = {{kTractor, TractorAt(1.4) * Inverse(TractorAt(0.9)), At(0.9)}};
  Apply(frame);
  EXPECT_EQ(Object(kTrailer).t_k(), At(1.4));
  EXPECT_LT(Strays_m(kTrailer, 2), 1e-9);
}

TEST_F(GroupMotion, LetAPartThatWasLongHiddenGoOnWhereItsWholeIs) {
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

TEST_F(GroupMotion, ShareAStatedFuture) {
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

}  // namespace
}  // namespace clearway
