// A scene and frames of several sensors, for tests of their stamps.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "clearway/scene/scene_builder.h"
#include "support/frames.h"

namespace clearway {

inline Frame Of(const std::string& sensor, Frame frame) {
  frame.sensor_id = sensor;
  return frame;
}

class SensorFrames : public testing::Test {
 protected:
  void SetUp() override { dut_.emplace(params_, limits_, pool_); }

  FrameReport Apply(const Frame& frame, const ApplyOptions& options = {}) {
    const auto report = dut_->Apply(frame, options);
    EXPECT_TRUE(report.ok()) << report.status();
    scene_ = dut_->Publish();
    return report.value_or(FrameReport());
  }
  // Refused without a trace.
  std::string Refusal(const Frame& frame) {
    const std::string hash = dut_->Publish()->Hash();
    const absl::Status status = dut_->Apply(frame).status();
    EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
    EXPECT_EQ(dut_->Publish()->Hash(), hash);
    return std::string(status.message());
  }
  VoxelState Static(const Eigen::Vector3d& p_W) const {
    return scene_->static_map_W.State(scene_->static_map_W.grid().KeyOf(p_W));
  }
  const MovingObject& Object(ObjectId id) const { return *scene_->FindObject(id); }

  ThreadPool pool_{2};
  SceneParams params_;
  FrameLimits limits_;
  std::optional<SceneBuilder> dut_;
  ScenePtr scene_;
};

inline Frame PointAt(const std::string& sensor, double seconds, const Eigen::Vector3d& p_S) {
  Frame frame = Of(sensor, testing_support::FrameAt(seconds));
  testing_support::AddPoint(frame, kStaticLabel, p_S);
  return frame;
}

}  // namespace clearway
