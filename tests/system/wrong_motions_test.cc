// A source that states wrong motions, frame after frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "clearway/scene/scene_builder.h"
#include "clearway/sim/simulation.h"

namespace clearway {
namespace {

constexpr double kPeriod_s = 0.1;
constexpr SpinningLidar kFewRays{
    .beams = 7, .azimuth_steps = 360, .lowest_rad = -0.2443, .highest_rad = 0.0175};

// A car of 4 m, which goes against x.
struct Car {
  double speed_mps = 5, x_m = 14, y_m = 2.5;
};

// In a hall of 80 x 32 m.
World HallWith(const Car& car) {
  World world;
  world.Add(Body::Single(kStaticLabel, "ground", Box{{80, 32, 0.1}},
                         FixedPose{Pose::Translation(0, 0, -0.05)}));
  for (const double wall_y_m : {-16.0, 16.0}) {
    world.Add(Body::Single(kStaticLabel, "wall", Box{{80, 0.1, 40}},
                           FixedPose{Pose::Translation(0, wall_y_m, 0)}));
  }
  for (const double x_m : {-40.0, 40.0}) {
    world.Add(Body::Single(kStaticLabel, "wall", Box{{0.1, 32, 40}},
                           FixedPose{Pose::Translation(x_m, 0, 0)}));
  }
  const Twist ahead{Eigen::Vector3d::Zero(), {-car.speed_mps, 0, 0}};
  world.Add(Body::Single(1, "car", Box{{4, 1.8, 1.5}},
                         ConstantTwist{Pose::Translation(car.x_m, car.y_m, 0.75), ahead}));
  return world;
}

// What a source says of the car.
using Saying = std::function<void(double seconds, Frame& frame)>;

void NothingWrong(double, Frame&) {}
void TheOtherWay(double, Frame& frame) {
  for (ObjectMotion& motion : frame.motions) motion.H_W = Inverse(motion.H_W);
}
void ThatItStands(double, Frame& frame) {
  for (ObjectMotion& motion : frame.motions) motion.H_W = Pose();
}
Saying PartOfTheWay(double part) {
  return [part](double, Frame& frame) {
    for (ObjectMotion& motion : frame.motions) motion.H_W.translation *= part;
  };
}
// As of another car that goes the other way.
void AnotherBox(double seconds, Frame& frame) {
  frame.motions.clear();
  frame.poses.push_back({1, Pose::Translation(8 + 5 * seconds, -2.5, 0.75)});
}

struct Outcome {
  std::size_t left_out = 0;
  double first_s = 0;  // when something was left out for the first time
  double longest_m = 0;
  MovingObject car;
};

Simulation Drive(std::size_t frames, const SpinningLidar& lidar, const Car& car) {
  SimulationSpec spec;
  spec.world = HallWith(car);
  spec.sensor = lidar;
  spec.sensor_trajectory = FixedPose{Pose::Translation(0, 0, 1.5)};
  spec.frame_count = frames;
  return Simulation(spec);
}

// Wrong from one frame on until another.
Outcome After(std::size_t frames, const Saying& saying, std::size_t from, std::size_t to = 100,
              const SpinningLidar& lidar = kFewRays, const Car& car = {}) {
  const Simulation simulation = Drive(frames, lidar, car);
  ThreadPool pool(1);
  SceneBuilder scene(SceneParams{}, FrameLimits{}, pool);
  Outcome outcome;
  for (std::size_t k = 0; k < frames; ++k) {
    Frame frame = simulation.MakeFrame(k);
    if (k >= from && k < to) saying(kPeriod_s * static_cast<double>(k), frame);
    const auto report = scene.Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    if (!report.ok()) return outcome;
    if (outcome.left_out == 0) outcome.first_s = ToSeconds(frame.stamp - Time());
    outcome.left_out += report->motions_implausible;
    outcome.car = *scene.Publish()->FindObject(1);
    outcome.longest_m = std::max(outcome.longest_m, outcome.car.solid->box_O.Size().x());
  }
  return outcome;
}

// Where the car truly is after so many frames, to within half a metre: the far end is not seen.
void ExpectFollowed(const Outcome& outcome, std::size_t frames) {
  const MovingObject& car = outcome.car;
  const Eigen::Vector3d center_W = car.history.back().T_W_O * car.solid->box_O.Center();
  const Car truth;
  const double seconds = kPeriod_s * static_cast<double>(frames - 1);
  EXPECT_NEAR(center_W.x(), truth.x_m - truth.speed_mps * seconds, 0.5);
  EXPECT_NEAR(center_W.y(), truth.y_m, 0.5);
  EXPECT_NEAR(car.solid->box_O.Size().x(), 4, 0.6);
  EXPECT_NEAR(car.SpeedMps(), truth.speed_mps, 0.5);
}

struct Case {
  const char* name;
  Saying saying;
  std::size_t from;
};

class WrongMotions : public testing::TestWithParam<Case> {};

TEST_P(WrongMotions, AreNamedAndThePointsCount) {
  const std::size_t from = GetParam().from;
  const Outcome outcome = After(25, GetParam().saying, from);
  EXPECT_GE(outcome.left_out + 4, 25 - from);
  EXPECT_LE(outcome.first_s, kPeriod_s * static_cast<double>(from) + 0.41);
  EXPECT_LT(outcome.longest_m, 8);
  ExpectFollowed(outcome, 25);
}

INSTANTIATE_TEST_SUITE_P(Of, WrongMotions,
                         testing::Values(Case{"TheOtherWay", TheOtherWay, 1},
                                         Case{"TheOtherWayLater", TheOtherWay, 10},
                                         Case{"ThatItStands", ThatItStands, 1},
                                         Case{"ThatItStandsLater", ThatItStands, 10},
                                         Case{"AnotherBox", AnotherBox, 0},
                                         Case{"AnotherBoxLater", AnotherBox, 10}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(WrongMotionsOfACar, ThatAreHalfAsFastAreNamedLater) {
  const Outcome outcome = After(40, PartOfTheWay(0.5), 1);
  EXPECT_GT(outcome.left_out, 10u);
  EXPECT_LE(outcome.first_s, 1.01);
  EXPECT_LT(outcome.longest_m, 9);
}

TEST(WrongMotionsOfACar, ThatAreAQuarterTooSlowOrTooFastAreNamedWithinTwoSeconds) {
  for (const double part : {0.75, 1.25}) {
    const Outcome outcome = After(40, PartOfTheWay(part), 1);
    EXPECT_GT(outcome.left_out, 10u) << part;
    EXPECT_LE(outcome.first_s, 2.11) << part;
    EXPECT_LT(outcome.longest_m, 8) << part;
  }
}

// The ground just beyond the car hides what is behind it from the lower beams.
TEST(WrongMotionsOfACar, FarFromALidarOfManyBeams) {
  const Car far{.speed_mps = 2, .x_m = 4, .y_m = 12};
  const Outcome outcome = After(25, ThatItStands, 1, 25, SpinningLidar::With64Beams(), far);
  EXPECT_GE(outcome.left_out, 15u);
  EXPECT_LE(outcome.first_s, 1.01);
  EXPECT_LT(outcome.longest_m, 7);
}

TEST(WrongMotionsOfACar, RightOnesAreNot) {
  const Outcome outcome = After(25, NothingWrong, 0);
  EXPECT_EQ(outcome.left_out, 0u);
  ExpectFollowed(outcome, 25);
}

// A second later.
TEST(WrongMotionsOfACar, RightOnesCountAgain) {
  const Outcome outcome = After(36, TheOtherWay, 10, 15);
  EXPECT_GT(outcome.left_out, 5u);
  EXPECT_LT(outcome.left_out, 20u);
  EXPECT_EQ(outcome.car.pose_source(), PoseSource::kReported);
  ExpectFollowed(outcome, 36);
}

}  // namespace
}  // namespace clearway
