// A car that is lost and comes back under another id.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {

inline constexpr double kPeriod_s = 0.1;
inline const std::vector<Eigen::Vector3d> kCar = testing_support::BoxSurface({4, 1.8, 1.5}, 0.08);

// A car that drives along x, `behind_m` behind the first.
inline Pose Driving(double t, double behind_m = 0) {
  return Pose::Translation(8 * t - behind_m, 0, 0);
}

class OtherIds : public testing::Test {
 protected:
  OtherIds() {
    params_.motion = MotionModel::kTrack;
    params_.reidentify = true;
  }
  void SetUp() override { dut_.emplace(params_, FrameLimits{}, pool_); }

  // What is seen of the car at that time, and its motion since the frame before.
  void See(Frame& frame, ObjectId id, double t, bool first, double behind_m = 0) {
    testing_support::AddObject(frame, id, Driving(t, behind_m), kCar);
    const Pose H_W = Driving(t, behind_m) * Inverse(Driving(t - kPeriod_s, behind_m));
    if (!first) frame.motions.push_back({id, H_W, testing_support::At(t - kPeriod_s)});
  }
  // Seen in every frame of that time.
  void SeeFor(ObjectId id, double from_s, double until_s) {
    for (double t = from_s; t < until_s - 1e-9; t += kPeriod_s) {
      Frame frame = testing_support::FrameAt(t);
      See(frame, id, t, t == from_s);
      Apply(frame);
    }
  }
  // The car, and far aside another one that stands, for a second.
  void SeeWithAnother(ObjectId id, ObjectId another, double from_s) {
    for (double t = from_s; t < from_s + 1; t += kPeriod_s) {
      Frame frame = testing_support::FrameAt(t);
      See(frame, id, t, t == from_s);
      testing_support::AddObject(frame, another, Pose::Translation(0, 30, 0), kCar);
      Apply(frame);
    }
  }
  void LoseAndSeeAgain() {
    SeeFor(5, 0, 2);
    SeeFor(9, 3.5, 4.5);
  }
  // 5, and 6 so far behind it, for two seconds.
  void SeeTwo(double behind_m) {
    for (double t = 0; t < 2; t += kPeriod_s) {
      Frame frame = testing_support::FrameAt(t);
      See(frame, 5, t, t == 0);
      See(frame, 6, t, t == 0, behind_m);
      Apply(frame);
    }
  }
  void Apply(const Frame& frame) {
    const auto report = dut_->Apply(frame);
    ASSERT_TRUE(report.ok()) << report.status();
    created_ += report->objects_created;
    dropped_ += report->objects_dropped;
    reidentified_ += report->objects_reidentified;
    versions_.push_back(dut_->Publish());
  }
  const SceneSnapshot& scene() const { return *versions_.back(); }

  ThreadPool pool_{1};
  SceneParams params_;
  std::optional<SceneBuilder> dut_;
  std::vector<ScenePtr> versions_;
  std::size_t created_ = 0, dropped_ = 0, reidentified_ = 0;
};

}  // namespace clearway
