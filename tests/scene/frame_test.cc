#include "clearway/scene/frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::At;

Frame Good() {
  Frame frame = testing_support::FrameAt(1.0);
  AddPoint(frame, 0, {1, 0, 0});
  AddPoint(frame, 7, {2, 0, 0});
  frame.motions.push_back({7, Pose::Translation(0.1, 0, 0), At(0.9)});
  frame.poses.push_back({8, Pose()});
  return frame;
}

template <class Change>
void ExpectRefused(Change change, const char* field,
                   absl::StatusCode code = absl::StatusCode::kInvalidArgument) {
  Frame frame = Good();
  change(frame);
  const absl::Status status = Validate(frame, {.max_points = 3, .max_objects = 3});
  EXPECT_EQ(status.code(), code) << field;
  EXPECT_THAT(std::string(status.message()), testing::StartsWith(field));
}

TEST(Frame, EmptyIsValid) { EXPECT_TRUE(Validate(Frame{}, {}).ok()); }

TEST(Frame, GoodIsValid) { EXPECT_TRUE(Validate(Good(), {}).ok()); }

TEST(Frame, PointsThatAreNotFiniteAreNoError) {
  Frame frame = Good();
  frame.points_S[0].x() = std::numeric_limits<float>::quiet_NaN();
  frame.points_S[1].y() = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(Validate(frame, {}).ok());
}

TEST(Frame, RefusesPoses) {
  ExpectRefused([](Frame& f) { f.T_W_S.translation.x() = NAN; }, "world_from_sensor");
  ExpectRefused([](Frame& f) { f.T_W_S.translation.x() = 2e5; }, "world_from_sensor.translation");
  ExpectRefused([](Frame& f) { f.T_W_S.rotation.coeffs().setZero(); },
                "world_from_sensor.rotation");
  ExpectRefused([](Frame& f) { f.T_W_S.rotation.w() = 1.011; }, "world_from_sensor.rotation");
  ExpectRefused([](Frame& f) { f.poses[0].T_W_B.translation.y() = INFINITY; },
                "poses[0].world_from_box");
  ExpectRefused([](Frame& f) { f.motions[0].H_W.rotation.x() = NAN; }, "motions[0].world_motion");
}

TEST(Frame, RefusesArraysOfDifferentLengths) {
  ExpectRefused([](Frame& f) { f.labels.pop_back(); }, "labels");
  ExpectRefused([](Frame& f) { f.no_return = {1}; }, "no_return");
  ExpectRefused([](Frame& f) { f.origins_S.resize(3); }, "origins");
}

TEST(Frame, RefusesLabelsBelowMinusOne) {
  ExpectRefused([](Frame& f) { f.labels[1] = -2; }, "labels[1]");
}

TEST(Frame, RefusesIds) {
  ExpectRefused([](Frame& f) { f.motions[0].id = 0; }, "motions[0].object_id");
  ExpectRefused([](Frame& f) { f.poses[0].id = 7; }, "poses[0].object_id");
}

// They are left out when the frame is applied.
TEST(Frame, ImplausibleMotionsAreWellFormed) {
  Frame frame = Good();
  frame.motions[0].H_W = {
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ())),
      {1e9, 0, 0}};
  EXPECT_TRUE(Validate(frame, {}).ok());
}

TEST(Frame, RefusesAMotionThatDoesNotStartBefore) {
  ExpectRefused([](Frame& f) { f.motions[0].from = f.stamp; }, "motions[0].from_stamp_ns");
}

TEST(Frame, RefusesStampsNearTheEndsOfTheirRange) {
  ExpectRefused([](Frame& f) { f.stamp = Time::max(); }, "stamp_ns");
  ExpectRefused([](Frame& f) { f.stamp = Time::min(); }, "stamp_ns");
  ExpectRefused([](Frame& f) { f.motions[0].from = Time::min(); }, "motions[0].from_stamp_ns");
}

TEST(Frame, RefusesTooMuch) {
  ExpectRefused([](Frame& f) { f.points_S.resize(4); }, "points",
                absl::StatusCode::kResourceExhausted);
  ExpectRefused(
      [](Frame& f) {
        for (int i = 20; i < 24; ++i) f.poses.push_back({i, Pose()});
      },
      "motions", absl::StatusCode::kResourceExhausted);
}

}  // namespace
}  // namespace clearway
