#include "scene/completion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "clearway/geometry/hull.h"
#include "clearway/scene/object_extent.h"
#include "clearway/scene/scene_builder.h"
#include "support/frames.h"
#include "support/random.h"

namespace clearway {
namespace {

using testing_support::At;
using testing_support::FrameAt;
using testing_support::Random;

const Eigen::Vector3d kCar(4.4, 1.8, 1.3);

// What a sensor to the right of it and behind it sees of a car, and what one behind it sees.
std::vector<Eigen::Vector3d> FlankAndBack() {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : testing_support::BoxSurface(kCar, 0.05)) {
    if (p.y() <= -0.5 * kCar.y() + 1e-9 || p.x() <= -0.5 * kCar.x() + 1e-9) points.push_back(p);
  }
  return points;
}
std::vector<Eigen::Vector3d> Back() {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : testing_support::BoxSurface(kCar, 0.05)) {
    if (p.x() <= -0.5 * kCar.x() + 1e-9) points.push_back(p);
  }
  return points;
}

Pose Placed(double x_m, double y_m, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())),
          {x_m, y_m, 0.0}};
}

// The object after views of it from the world's origin, ten a second.
MovingObject Seen(const std::vector<Eigen::Vector3d>& points_B, int views,
                  const std::function<Pose(double)>& T_W_B, SolidMode solid,
                  ObjectId part_of = kStaticLabel) {
  SceneParams params;
  params.solid = solid;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  for (int k = 0; k < views; ++k) {
    Frame frame = FrameAt(0.1 * k);
    testing_support::AddObject(frame, 1, T_W_B(0.1 * k), points_B);
    frame.poses = {{1, T_W_B(0.1 * k)}};
    if (part_of != kStaticLabel) frame.parts = {{1, part_of}};
    EXPECT_TRUE(builder.Apply(frame).ok());
  }
  return *builder.Publish()->objects.at(0);
}

double VolumeOf(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  }
  return volume;
}

double Reach_m(const MovingObject& object, const Eigen::Vector3d& axis_O) {
  double least = 1e9, most = -1e9;
  for (const Eigen::Vector3d& p_O : object.solid->hull->vertices) {
    least = std::min(least, axis_O.dot(p_O));
    most = std::max(most, axis_O.dot(p_O));
  }
  return most - least;
}

TEST(Completion, MakesABoxOfAFlankAndABack) {
  for (const double yaw_rad : {0.0, 0.7, 2.1, -2.9}) {
    const Eigen::Vector3d ahead(std::cos(yaw_rad), std::sin(yaw_rad), 0);
    // The sensor is behind it, at its right.
    const Pose start = Placed(0, 0, yaw_rad) * Pose::Translation(8, 5, 0);
    const auto drive = [&](double t_s) {
      return Pose{start.rotation, start.translation + 10 * t_s * ahead};
    };
    const MovingObject seen = Seen(FlankAndBack(), 8, drive, SolidMode::kConvexHull);
    const MovingObject dut = Seen(FlankAndBack(), 8, drive, SolidMode::kCompletedHull);
    EXPECT_FALSE(seen.completion);
    ASSERT_TRUE(dut.completion);
    EXPECT_NEAR(dut.completion->yaw_rad, yaw_rad, 1e-3);
    EXPECT_TRUE(dut.completion->length_seen);
    const double whole_m3 = (kCar + Eigen::Vector3d::Constant(0.1)).prod();
    EXPECT_LT(VolumeOf(*seen.solid->hull), 0.65 * whole_m3) << yaw_rad;
    EXPECT_GT(VolumeOf(*dut.solid->hull), 0.93 * whole_m3) << yaw_rad;
    EXPECT_LT(VolumeOf(*dut.solid->hull), 1.2 * whole_m3) << yaw_rad;
    EXPECT_EQ(ExtentOf(dut).size_m, ExtentOf(seen).size_m);  // that of what was seen
  }
}

// Whatever the points: it holds the hull and its mirror image, and goes no farther than the hull
// does along its axes.
TEST(Completion, OfAnyHull) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    std::vector<Eigen::Vector3d> points;
    for (int p = 0; p < random.Integer(4, 60); ++p) {
      points.push_back((20 * random.Vector(1)).array().round());
    }
    const Mesh hull = ConvexHullOf(points);
    if (hull.triangles.empty()) continue;
    const double yaw_rad = i % 5 == 0 ? 0 : random.Uniform(-std::numbers::pi, std::numbers::pi);
    std::vector<Eigen::Vector3d> completed = hull.vertices;
    AddUnseen({yaw_rad, 0, true}, completed);
    const Mesh dut = ConvexHullOf(completed);
    const Eigen::Vector3d ahead(std::cos(yaw_rad), std::sin(yaw_rad), 0);
    const Eigen::Vector3d aside(-std::sin(yaw_rad), std::cos(yaw_rad), 0);
    Aabb box, of_hull;  // along ahead, aside and up
    const auto in_axes = [&](const Eigen::Vector3d& p) {
      return Eigen::Vector3d(ahead.dot(p), aside.dot(p), p.z());
    };
    for (const Eigen::Vector3d& p : hull.vertices) of_hull.Extend(in_axes(p));
    for (const Eigen::Vector3d& p : dut.vertices) box.Extend(in_axes(p));
    EXPECT_LT((box.min - of_hull.min).cwiseAbs().maxCoeff(), 1e-3) << i;
    EXPECT_LT((box.max - of_hull.max).cwiseAbs().maxCoeff(), 1e-3) << i;

    for (const Eigen::Vector3d& p : hull.vertices) {
      const Eigen::Vector3d mirrored =
          p + (of_hull.min.y() + of_hull.max.y() - 2 * aside.dot(p)) * aside;
      EXPECT_TRUE(NearHull(dut, p, 1e-9)) << i;
      EXPECT_TRUE(NearHull(dut, mirrored, 1e-3)) << i;
    }
  }
}

// Ahead of the sensor, on its lane.
Pose Leading(double t_s) { return Pose::Translation(15 + 10 * t_s, 0, 0); }

TEST(Completion, AVehicleSeenFromBehindGoesOnAhead) {
  const MovingObject dut = Seen(Back(), 8, Leading, SolidMode::kCompletedHull);
  ASSERT_TRUE(dut.completion);
  EXPECT_EQ(dut.completion->unseen_end, 1);
  EXPECT_FALSE(dut.completion->length_seen);
  EXPECT_NEAR(Reach_m(dut, Eigen::Vector3d::UnitX()), 2 * 1.9, 0.21);
  const Eigen::Vector3d back_O =
      Inverse(dut.history.back().T_W_O) * (Leading(0.7) * Eigen::Vector3d(-2.2, 0, 0));
  EXPECT_NEAR(dut.solid->box_O.min.x(), back_O.x(), 0.11);
}

TEST(Completion, AVehicleSeenFromBeforeGoesOnBehind) {
  const auto oncoming = [](double t_s) { return Placed(60 - 10 * t_s, 0, std::numbers::pi); };
  std::vector<Eigen::Vector3d> front = Back();
  for (Eigen::Vector3d& p : front) p.x() = -p.x();
  const MovingObject dut = Seen(front, 8, oncoming, SolidMode::kCompletedHull);
  ASSERT_TRUE(dut.completion);
  EXPECT_EQ(dut.completion->unseen_end, -1);
  EXPECT_NEAR(std::abs(dut.completion->yaw_rad), std::numbers::pi, 1e-3);
  EXPECT_NEAR(Reach_m(dut, Eigen::Vector3d::UnitX()), 2 * 1.9, 0.21);
}

TEST(Completion, ItsLengthIsWhatWasSeenOnceItsFlankWas) {
  // It changes to a lane on the left, as it drives.
  const auto changes = [](double t_s) {
    const double y_m = 5 * std::clamp(t_s - 1, 0.0, 2.0);
    return Placed(8 + 10 * t_s, y_m, y_m > 0 && y_m < 10 ? std::atan(0.5) : 0);
  };
  EXPECT_EQ(Seen(Back(), 10, changes, SolidMode::kCompletedHull).completion->unseen_end, 1);
  const MovingObject dut = Seen(Back(), 45, changes, SolidMode::kCompletedHull);
  EXPECT_TRUE(dut.completion->length_seen);
  EXPECT_EQ(dut.completion->unseen_end, 0);
  EXPECT_LT(Reach_m(dut, Eigen::Vector3d::UnitX()), 0.4);
}

TEST(Completion, WhatIsSlowOrAPartIsAsLongAsItIsSeen) {
  const auto slow = [](double t_s) { return Pose::Translation(15 + 2 * t_s, 0, 0); };
  EXPECT_EQ(Seen(Back(), 12, slow, SolidMode::kCompletedHull).completion->unseen_end, 0);
  EXPECT_EQ(Seen(Back(), 12, Leading, SolidMode::kCompletedHull, 7).completion->unseen_end, 0);
}

TEST(Completion, NoneBeforeItsDirectionIsKnownAndTheLastOneAtRest) {
  EXPECT_FALSE(Seen(Back(), 1, Leading, SolidMode::kCompletedHull).completion);
  const auto stands = [](double) { return Leading(0); };
  EXPECT_FALSE(Seen(Back(), 20, stands, SolidMode::kCompletedHull).completion);
  const auto stops = [](double t_s) { return Leading(std::min(t_s, 1.0)); };
  const MovingObject dut = Seen(Back(), 40, stops, SolidMode::kCompletedHull);
  ASSERT_TRUE(dut.completion);
  EXPECT_EQ(dut.completion->unseen_end, 1);
  EXPECT_NEAR(Reach_m(dut, Eigen::Vector3d::UnitX()), 2 * 1.9, 0.21);
}

TEST(Completion, OfFramesFarApart) {
  const auto points = Back();
  SceneParams params;
  params.solid = SolidMode::kCompletedHull;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  for (const double t_s : {0.0, 1.5, 3.0}) {
    Frame frame = FrameAt(t_s);
    testing_support::AddObject(frame, 1, Leading(t_s), points);
    frame.poses = {{1, Leading(t_s)}};
    ASSERT_TRUE(builder.Apply(frame).ok());
  }
  ASSERT_TRUE(builder.Publish()->objects.at(0)->completion);
  params.history = std::chrono::milliseconds(900);
  EXPECT_EQ(Validate(params).code(), absl::StatusCode::kInvalidArgument);
}

// Two poses that are off by half a metre are no course, however fast that would be.
TEST(Completion, NoneInTheFirstHalfSecond) {
  EXPECT_FALSE(Seen(Back(), 4, Leading, SolidMode::kCompletedHull).completion);
  EXPECT_TRUE(Seen(Back(), 7, Leading, SolidMode::kCompletedHull).completion);
}

TEST(Completion, WhatIsSeenAgainKnowsWhatBothKnew) {
  const Pose T_Y_L = Placed(3, 1, 0.5);
  const Completion open{0.7, 1, false}, met{0.2, 0, true};
  EXPECT_EQ(JoinedCompletion(open, std::nullopt, T_Y_L), open);
  const auto dut = JoinedCompletion(met, open, T_Y_L);
  EXPECT_NEAR(dut->yaw_rad, 0.2, 1e-9);
  EXPECT_EQ(dut->unseen_end, 0);
  EXPECT_TRUE(dut->length_seen);
  EXPECT_EQ(JoinedCompletion(std::nullopt, open, T_Y_L)->unseen_end, 1);
  EXPECT_EQ(JoinedCompletion(open, met, T_Y_L)->unseen_end, 0);
}

TEST(Completion, ToldToBeAPartItEndsWhereItWasSeen) {
  SceneParams params;
  params.solid = SolidMode::kCompletedHull;
  ThreadPool pool(1);
  SceneBuilder builder(params, {}, pool);
  for (int k = 0; k <= 8; ++k) {
    Frame frame = FrameAt(0.1 * k);
    if (k < 8) testing_support::AddObject(frame, 1, Leading(0.1 * k), Back());
    frame.poses = {{1, Leading(0.1 * k)}};
    if (k == 8) frame.parts = {{1, 7}};  // and it is hidden
    ASSERT_TRUE(builder.Apply(frame).ok());
    if (k == 7) {
      EXPECT_EQ(builder.Publish()->objects.at(0)->completion->unseen_end, 1);
    }
  }
  const MovingObject dut = *builder.Publish()->objects.at(0);
  EXPECT_EQ(dut.completion->unseen_end, 0);
  EXPECT_LT(Reach_m(dut, Eigen::Vector3d::UnitX()), 0.3);
}

// A boom goes sideways where its middle is.
TEST(Completion, NoneOfWhatSwings) {
  const auto swings = [](double t_s) {
    return Placed(12, 0, 0.8 * t_s) * Pose::Translation(2.2, 0, 0);
  };
  const auto points = testing_support::BoxSurface({4.4, 0.6, 0.6}, 0.05);
  EXPECT_FALSE(Seen(points, 20, swings, SolidMode::kCompletedHull).completion);
}

// The middle of a car that turns goes along its length, whatever O's origin does.
TEST(Completion, OfWhatTurnsTheDirectionIsThatOfItsMiddle) {
  const auto turns = [](double t_s) {
    return Placed(30, 0, 0) * Exp({{0, 0, 0.6 * t_s}, {6 * t_s, 0, 0}});
  };
  const MovingObject dut =
      Seen(testing_support::BoxSurface(kCar, 0.05), 15, turns, SolidMode::kCompletedHull);
  ASSERT_TRUE(dut.completion);
  const Eigen::Quaterniond R_B_O =
      turns(1.4).rotation.conjugate() * dut.history.back().T_W_O.rotation;
  const double heading_in_O_rad = -2 * std::atan2(R_B_O.z(), R_B_O.w());
  EXPECT_NEAR(std::remainder(dut.completion->yaw_rad - heading_in_O_rad, 2 * std::numbers::pi), 0,
              0.02);
}

}  // namespace
}  // namespace clearway
