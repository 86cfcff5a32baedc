#include "scene/label_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "clearway/scene/scene_builder.h"
#include "scene/direction_grid.h"
#include "scene/occupied_centers.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddPoint;
using testing_support::At;
using testing_support::FrameAt;
using testing_support::Random;

constexpr ObjectId kCar = 1, kPerson = 2, kFarCar = 3;

struct Thing {
  ObjectId label;
  Aabb box;
};

// A street before a wall: ground, a car with a person next to it, and a car far away.
const std::vector<Thing>& Street() {
  static const std::vector<Thing> street = {
      {kStaticLabel, {{-1, -40, -2}, {60, 40, -1.7}}},
      {kStaticLabel, {{55, -40, -2}, {56, 40, 4}}},
      {kStaticLabel, {{12, -5, -1.7}, {12.2, -4.8, 3}}},
      {kCar, {{8, -1, -1.6}, {12, 1, -0.2}}},
      {kPerson, {{7.5, 1.3, -1.6}, {7.9, 1.8, 0.1}}},
      {kFarCar, {{40, 6, -1.6}, {44, 8, -0.2}}},
  };
  return street;
}

// What a LiDAR at the origin sees, so many degrees from ray to ray.
Frame Scan(double seconds, const std::vector<Thing>& things, double across_deg = 0.5,
           double up_deg = 0.5) {
  Frame frame = FrameAt(seconds);
  constexpr double kDegree = std::numbers::pi / 180;
  const int lowest = static_cast<int>(-20 / up_deg), highest = static_cast<int>(2 / up_deg);
  const int most = static_cast<int>(35 / across_deg);
  for (int row = lowest; row <= highest; ++row) {
    for (int column = -most; column <= most; ++column) {
      const double up = row * up_deg * kDegree, left = column * across_deg * kDegree;
      const Eigen::Vector3d d(std::cos(up) * std::cos(left), std::cos(up) * std::sin(left),
                              std::sin(up));
      double range_m = 58;
      ObjectId label = kIgnoreLabel;
      for (const Thing& thing : things) {
        const LinePart part = Clip(thing.box, Eigen::Vector3d::Zero(), d, {0, range_m});
        if (part.begin >= part.end) continue;
        range_m = part.begin;
        label = thing.label;
      }
      if (label != kIgnoreLabel) AddPoint(frame, label, range_m * d);
    }
  }
  return frame;
}

class LabelFilter : public testing::Test {
 protected:
  LabelFilter() {
    params_.rays.max_range_m = 60;
    params_.filter_labels = true;
  }
  struct Outcome {
    std::size_t doubted = 0;
    std::set<std::size_t> indices;  // of the frame's points
    LabelledCloud cloud;
  };
  Outcome Filtered(const Frame& frame, const SceneObjects& objects = {}) {
    FrameReport report;
    const LabelledCloud before = PlaceCloud(frame, params_, report);
    Outcome outcome;
    outcome.cloud = before;
    outcome.doubted = LeaveOutDoubtful(objects, frame.stamp, params_, outcome.cloud).doubted;
    for (const auto& [id, points] : before.object_hits) {
      const auto& left = outcome.cloud.object_hits[id];
      const std::set<std::uint32_t> kept(left.begin(), left.end());
      for (const std::uint32_t i : points) {
        if (!kept.contains(i)) outcome.indices.insert(i);
      }
    }
    for (std::size_t i = 0; i < before.kinds.size(); ++i) {
      if (outcome.cloud.kinds[i] != before.kinds[i]) outcome.indices.insert(i);
    }
    EXPECT_EQ(outcome.doubted, outcome.indices.size());
    return outcome;
  }

  ThreadPool pool_{1};
  SceneParams params_;
};

int OccupiedIn(const Aabb& box, const VoxelMap& map) {
  const std::vector<Eigen::Vector3d> centers = OccupiedCenters(map);
  return static_cast<int>(
      std::ranges::count_if(centers, [&](const auto& center) { return box.Contains(center); }));
}

std::size_t PointsOf(ObjectId id, const Frame& frame) {
  return static_cast<std::size_t>(std::ranges::count(frame.labels, id));
}

TEST_F(LabelFilter, BelievesLabelsThatAreRight) {
  const Frame frame = Scan(0, Street());
  ASSERT_GT(PointsOf(kCar, frame), 400u);
  ASSERT_GT(PointsOf(kPerson, frame), 80u);
  ASSERT_GT(PointsOf(kFarCar, frame), 8u);
  EXPECT_EQ(Filtered(frame).doubted, 0u);
}

// One of twenty gets another label, of all kinds.
struct Spacing {
  double across_deg, up_deg;
  double missed, good;  // at most: share of the wrong ones, and of all points in vain
};
class LabelFilterOfScans : public LabelFilter, public testing::WithParamInterface<Spacing> {};
TEST_P(LabelFilterOfScans, DoubtsWrongOnesAndThemAlone) {
  const Frame truth = Scan(0, Street(), GetParam().across_deg, GetParam().up_deg);
  Random random(1);
  std::size_t wrong = 0, missed = 0, good = 0;
  for (int round = 0; round < 20; ++round) {
    Frame frame = truth;
    std::set<std::size_t> changed;
    for (std::size_t i = 0; i < frame.labels.size(); ++i) {
      if (random.Integer(0, 19) != 0) continue;
      frame.labels[i] = (frame.labels[i] + random.Integer(1, 3)) % 4;
      changed.insert(i);
    }
    const Outcome outcome = Filtered(frame);
    for (const std::size_t i : changed) missed += !outcome.indices.contains(i);
    for (const std::size_t i : outcome.indices) good += !changed.contains(i);
    wrong += changed.size();
  }
  EXPECT_GT(wrong, truth.labels.size() / 2);
  EXPECT_LT(static_cast<double>(missed), GetParam().missed * static_cast<double>(wrong));
  EXPECT_LT(static_cast<double>(good), GetParam().good * 20.0 * truth.labels.size());
}
INSTANTIATE_TEST_SUITE_P(, LabelFilterOfScans,
                         testing::Values(Spacing{0.5, 0.5, 0.01, 0.0025},
                                         Spacing{0.2, 2, 0.01, 0.0025},
                                         Spacing{1.4, 1.4, 0.03, 0.03},  // of few points
                                         Spacing{1.4, 2, 0.03, 0.03}));

// Points so near the sensor that their direction can hardly be told.
TEST_F(LabelFilter, TakesPointsAtTheSensor) {
  Frame frame = Scan(0, Street());
  AddPoint(frame, kCar, {1e-40, 0, 0});
  AddPoint(frame, kStaticLabel, {0, -1e-41, 0});
  AddPoint(frame, kCar, {1e-38, 1e-38, -1e-45});
  params_.filter_labels = true;
  EXPECT_TRUE(SceneBuilder(params_, {}, pool_).Apply(frame).ok());
}

// Far away, with few beams, an object has few points, and nothing around them.
TEST_F(LabelFilter, LeavesObjectsThatAreSparselySeen) {
  for (const double turn_rad : {0.0, 0.6, std::numbers::pi / 4, 2.0, -2.4}) {
    const Pose turn(Eigen::Quaterniond(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ())),
                    Eigen::Vector3d::Zero());
    Frame frame = FrameAt(0);
    for (int beam = 0; beam < 6; ++beam) {
      for (int column = 0; column < 2; ++column) {
        AddPoint(frame, kCar, turn * Eigen::Vector3d(20, 0.14 * column, 0.7 * beam - 2));
      }
    }
    EXPECT_TRUE(Filtered(frame).indices.empty()) << turn_rad;
  }
}

// Of an object that is known, even less is believed, but where it is.
TEST_F(LabelFilter, BelievesAGlimpseOfWhatIsKnown) {
  params_.filter_labels = true;
  const auto points_of_glimpse = [&](double y_m) {
    SceneBuilder builder(params_, {}, pool_);
    for (int k = 0; k < 4; ++k) EXPECT_TRUE(builder.Apply(Scan(0.1 * k, Street())).ok());
    Frame frame = FrameAt(0.4);
    for (const double z_m : {-1.5, -0.9, -0.3}) AddPoint(frame, kCar, {8, y_m, z_m});
    EXPECT_TRUE(builder.Apply(frame).ok());
    const MovingObject& car = *builder.Publish()->FindObject(kCar);
    return car.last_seen == frame.stamp;
  };
  EXPECT_TRUE(points_of_glimpse(0.5));
  EXPECT_FALSE(points_of_glimpse(20));
}

// As a depth camera sees: many points in each direction.
TEST_F(LabelFilter, FindsWrongLabelsAmongManyPoints) {
  Random random(3);
  Frame frame = FrameAt(0);
  std::set<std::size_t> changed;
  for (double y_m = -0.5; y_m < 0.5; y_m += 0.004) {
    for (double z_m = -0.3; z_m < 0.3; z_m += 0.004) {
      ObjectId label = y_m < 0 ? kStaticLabel : kCar;
      if (random.Integer(0, 49) == 0) {
        label = label == kCar ? kStaticLabel : kCar;
        changed.insert(frame.points_S.size());
      }
      AddPoint(frame, label, {3, y_m, z_m});
    }
  }
  const Outcome outcome = Filtered(frame);
  std::size_t found = 0;
  for (const std::size_t i : outcome.indices) found += changed.contains(i);
  EXPECT_GT(found, 0.9 * static_cast<double>(changed.size()));
  EXPECT_LT(outcome.indices.size() - found, frame.labels.size() / 100);
}

// Their rays clear what is before them, and they hit nothing.
TEST_F(LabelFilter, DoubtedPointsBlockTheirRays) {
  Frame frame = Scan(0, Street());
  const auto on_car =
      static_cast<std::size_t>(std::ranges::find_if(frame.points_S,
                                                    [](const Eigen::Vector3f& p) {
                                                      return std::abs(p.x() - 8) < 1e-3 &&
                                                             std::abs(p.y()) < 0.1 &&
                                                             std::abs(p.z() + 1) < 0.1;
                                                    }) -
                               frame.points_S.begin());
  ASSERT_EQ(frame.labels.at(on_car), kCar);
  frame.labels[on_car] = kStaticLabel;
  EXPECT_EQ(Filtered(frame).indices, std::set<std::size_t>{on_car});

  const auto static_state = [&](bool filter_labels) {
    params_.filter_labels = filter_labels;
    SceneBuilder builder(params_, {}, pool_);
    EXPECT_EQ(builder.Apply(frame)->points_doubted, filter_labels ? 1u : 0u);
    const VoxelMap& map_W = builder.Publish()->static_map_W;
    const Eigen::Vector3d p_W = frame.points_S[on_car].cast<double>();
    EXPECT_EQ(map_W.State(map_W.grid().KeyOf(0.9 * p_W)), VoxelState::kFree);
    return map_W.State(map_W.grid().KeyOf(p_W));
  };
  EXPECT_EQ(static_state(false), VoxelState::kOccupied);
  EXPECT_NE(static_state(true), VoxelState::kOccupied);
}

// The front of a car that comes nearer: a strip of it is called static once, too wide to be
// outvoted, before anybody knows the car. No ray passes there again.
TEST_F(LabelFilter, WhatABelievedPointLeftInAnObjectIsForgotten) {
  constexpr double kStep_m = 6, kPeriod_s = 0.1;
  SceneBuilder builder(params_, {}, pool_);
  const auto scan = [&](int k, bool strip_is_wrong) {
    const double front_m = 20 - k * kStep_m;
    const Thing car{kCar, {{front_m, -1, -1.6}, {front_m + 4, 1, -0.2}}};
    Frame frame = Scan(k * kPeriod_s, {Street()[0], Street()[1], car});
    for (std::size_t i = 0; i < frame.labels.size(); ++i) {
      const double slope = frame.points_S[i].y() / frame.points_S[i].x();
      const bool is_in_strip = strip_is_wrong && slope > -0.03 && slope < -0.005;
      if (frame.labels[i] == kCar && is_in_strip) frame.labels[i] = kStaticLabel;
    }
    const ObjectMotion motion{kCar, Pose::Translation(-kStep_m, 0, 0), At((k - 1) * kPeriod_s)};
    if (k > 0) frame.motions.push_back(motion);
    ASSERT_TRUE(builder.Apply(frame).ok());
  };
  const Aabb front_then_W{{13.9, -1, -1.4}, {14.1, 1, -0.3}};
  scan(0, false);
  scan(1, true);
  EXPECT_GT(OccupiedIn(front_then_W, builder.Publish()->static_map_W), 20);
  scan(2, false);
  EXPECT_EQ(OccupiedIn(front_then_W, builder.Publish()->static_map_W), 0);
}

// A single point on a car that is known, with none of the car's beside it, a person's far behind.
TEST_F(LabelFilter, WhatALonePointLeftInAnObjectIsForgotten) {
  SceneBuilder builder(params_, {}, pool_);
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(builder.Apply(Scan(0.1 * k, Street())).ok());
  const Eigen::Vector3d alone_W(8.02, 0.87, -1.02);
  const auto glimpse = [&](int k) {
    Frame frame = FrameAt(0.1 * k);
    for (int i = 0; i < 12; ++i) {
      AddPoint(frame, kCar, {8, -0.9 + 0.05 * (i / 2), -1.5 + 0.1 * (i % 2)});
    }
    AddPoint(frame, kPerson, 1.2 * alone_W);
    if (k == 4) AddPoint(frame, kStaticLabel, alone_W);
    ASSERT_TRUE(builder.Apply(frame).ok());
  };
  const auto state = [&] {
    const VoxelMap& map_W = builder.Publish()->static_map_W;
    return map_W.State(map_W.grid().KeyOf(alone_W));
  };
  glimpse(4);
  EXPECT_EQ(state(), VoxelState::kOccupied);
  glimpse(5);
  EXPECT_NE(state(), VoxelState::kOccupied);
}

TEST_F(LabelFilter, GroundBesideAnObjectThatStandsStays) {
  SceneBuilder builder(params_, {}, pool_);
  const Thing car{kCar, {{8, -1, -1.72}, {12, 1, -0.2}}};
  const auto scan = [&](int k) {
    ASSERT_TRUE(builder.Apply(Scan(0.1 * k, {Street()[0], Street()[1], car}, 0.5, 0.1)).ok());
  };
  scan(0);
  const std::vector<Eigen::Vector3d> first = OccupiedCenters(builder.Publish()->static_map_W);
  for (int k = 1; k < 5; ++k) {
    scan(k);
    const VoxelMap& map_W = builder.Publish()->static_map_W;
    const auto lost = std::ranges::count_if(first, [&](const Eigen::Vector3d& center_W) {
      return map_W.State(map_W.grid().KeyOf(center_W)) != VoxelState::kOccupied;
    });
    EXPECT_EQ(lost, 0) << k;
  }
}

// A few points next to each other with a new id before nothing else: not enough to be an object.
TEST_F(LabelFilter, ObjectsDoNotBeginFromStrayPoints) {
  const auto created = [&](int points) {
    Frame frame = FrameAt(0);
    for (int i = 0; i < points; ++i) AddPoint(frame, 9, {20, 0.15 * (i % 3), 0.15 * (i / 3)});
    SceneBuilder builder(params_, {}, pool_);
    return builder.Apply(frame)->objects_created;
  };
  EXPECT_EQ(created(1), 0u);
  EXPECT_EQ(created(4), 0u);
  EXPECT_EQ(created(5), 1u);
}

// A part of the car that is called static in one scan, too large to be outvoted.
TEST_F(LabelFilter, WhatIsKnownOfAnObjectBearsItsPointsOut) {
  SceneBuilder builder(params_, {}, pool_);
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(builder.Apply(Scan(0.1 * k, Street())).ok());
  Frame frame = Scan(0.3, Street());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < frame.labels.size(); ++i) {
    if (frame.labels[i] != kCar || frame.points_S[i].y() > -0.3f) continue;
    frame.labels[i] = kStaticLabel;
    ++wrong;
  }
  const std::size_t at_edge = Filtered(frame).doubted;
  EXPECT_LT(at_edge, wrong / 4);
  EXPECT_GT(Filtered(frame, builder.Publish()->objects).doubted, at_edge + 10);
}

TEST_F(LabelFilter, PointsOfGivenObjectsAreCountedOnce) {
  Frame frame = Scan(0, Street());
  frame.labels[0] = kCar;  // of the ground before the sensor
  SceneBuilder builder(params_, {}, pool_);
  const Aabb& box = Street()[3].box;
  GivenObject given;
  given.id = kCar;
  given.shape = Box{box.Size()};
  given.pose = {frame.stamp, {Eigen::Quaterniond::Identity(), box.Center()}};
  ASSERT_TRUE(builder.AddObject(given).ok());
  const FrameReport report = *builder.Apply(frame);
  EXPECT_EQ(report.points_doubted, 1u);
  EXPECT_EQ(report.points_given, PointsOf(kCar, frame) - 1);
}

TEST_F(LabelFilter, TakesAnOriginForEachPoint) {
  Frame frame = Scan(0, Street());
  frame.labels[0] = kCar;
  const std::set<std::size_t> expected = Filtered(frame).indices;
  frame.origins_S.assign(frame.points_S.size(), Eigen::Vector3f::Zero());
  EXPECT_EQ(Filtered(frame).indices, expected);
}

TEST_F(LabelFilter, TakesFramesOfEveryKind) {
  testing_support::RandomFrames frames(3);
  SceneBuilder builder(params_, {}, pool_);
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(builder.Apply(frames.Next()).ok());
  Frame at_sensor = FrameAt(1'000);
  for (int i = 0; i < 10; ++i) AddPoint(at_sensor, i % 2, {0, 0, 0});
  EXPECT_TRUE(builder.Apply(at_sensor).ok());
}

// What is asked for speed alone says nothing else than the votes do.
TEST_F(LabelFilter, QuickAnswersAgreeWithTheVotes) {
  Frame frame = Scan(0, Street());
  Random random(2);
  for (ObjectId& label : frame.labels) {
    if (random.Integer(0, 9) == 0) label = random.Integer(0, 3);
  }
  FrameReport report;
  const LabelledCloud cloud = PlaceCloud(frame, params_, report);
  const DirectionGrid dut(cloud);
  std::size_t alone = 0, among_fellows = 0;
  for (std::size_t k = 0; k < dut.size(); ++k) {
    const DirectionGrid::Votes votes = dut.VotesOn(k);
    EXPECT_TRUE(votes.fellows == 0 || dut.HasFellow(k));
    alone += !dut.HasFellow(k);
    EXPECT_TRUE(votes.others == 0 || dut.MayHaveOthers(k));
    among_fellows += !dut.MayHaveOthers(k);
  }
  EXPECT_GT(alone, 10u);
  EXPECT_GT(among_fellows, 10u);
}

}  // namespace
}  // namespace clearway
