// A scene of a truck and its trailer, of which frames tell this or that.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {

inline constexpr ObjectId kTractor = 1, kTrailer = 2;
inline constexpr double kPeriod_s = 0.1, kSpeed_mps = 5, kTurn_radps = 0.5;
inline const std::vector<Eigen::Vector3d> kBody = testing_support::BoxSurface({3, 2, 2}, 0.1);

inline Pose TurnedBy(double yaw_rad) { return Exp({{0, 0, yaw_rad}, Eigen::Vector3d::Zero()}); }
inline Pose Swung(double pitch_rad) { return Exp({{0, pitch_rad, 0}, Eigen::Vector3d::Zero()}); }

// A tractor that goes in a circle, and its trailer, at a constant angle behind it.
inline Pose TractorAt(double t) {
  return TurnedBy(kTurn_radps * t) * Pose::Translation(kSpeed_mps / kTurn_radps, 0, 0) *
         TurnedBy(M_PI / 2);
}
inline Pose TrailerAt(double t) {
  return TractorAt(t) * Pose::Translation(-1.7, 0, 0) * TurnedBy(-0.3) *
         Pose::Translation(-1.7, 0, 0);
}

inline double Apart_m(const Pose& a, const Pose& b) {
  return (a.translation - b.translation).norm();
}

class TruckScene : public testing::Test {
 protected:
  using Place = Pose (*)(double);

  void SetUp() override { dut_.emplace(params_, FrameLimits{}, pool_); }

  static Frame TruckAt(double t) {
    Frame frame = testing_support::FrameAt(t);
    frame.parts = {{kTrailer, kTractor}};
    return frame;
  }
  static void See(Frame& frame, ObjectId id, Place place) {
    testing_support::AddObject(frame, id, place(ToSeconds(frame.stamp - testing_support::At(0))),
                               kBody);
  }
  static void Move(Frame& frame, ObjectId id, Place place) {
    const double t = ToSeconds(frame.stamp - testing_support::At(0));
    if (t <= 0) return;
    frame.motions.push_back(
        {id, place(t) * Inverse(place(t - kPeriod_s)), testing_support::At(t - kPeriod_s)});
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
    return PredictPose(Object(id), testing_support::At(at_s), params_.horizon).T_W_O;
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

}  // namespace clearway
