// Motions the other way, as seen by a LiDAR of few rays.
#include <gtest/gtest.h>

#include "clearway/scene/scene_builder.h"
#include "clearway/sim/simulation.h"

namespace clearway {
namespace {

constexpr double kSpeed_mps = 5, kPeriod_s = 0.1;

// A car of 4 m in a hall of 80 x 24 m, that comes from x = 14 m along y = 2.5 m.
World HallWithCar() {
  World world;
  world.Add(Body::Single(kStaticLabel, "ground", Box{{80, 24, 0.1}},
                         FixedPose{Pose::Translation(0, 0, -0.05)}));
  for (const double y_m : {-12.0, 12.0}) {
    world.Add(Body::Single(kStaticLabel, "wall", Box{{80, 0.1, 40}},
                           FixedPose{Pose::Translation(0, y_m, 0)}));
  }
  for (const double x_m : {-40.0, 40.0}) {
    world.Add(Body::Single(kStaticLabel, "wall", Box{{0.1, 24, 40}},
                           FixedPose{Pose::Translation(x_m, 0, 0)}));
  }
  const Twist ahead{Eigen::Vector3d::Zero(), {-kSpeed_mps, 0, 0}};
  world.Add(Body::Single(1, "car", Box{{4, 1.8, 1.5}},
                         ConstantTwist{Pose::Translation(14, 2.5, 0.75), ahead}));
  return world;
}

struct Outcome {
  std::size_t left_out = 0;
  double length_m = 0;
};

Outcome After(std::size_t frames, bool inverse) {
  SimulationSpec spec;
  spec.world = HallWithCar();
  spec.sensor =
      SpinningLidar{.beams = 7, .azimuth_steps = 360, .lowest_rad = -0.2443, .highest_rad = 0.0175};
  spec.sensor_trajectory = FixedPose{Pose::Translation(0, 0, 1.5)};
  spec.frame_count = frames;
  const Simulation simulation(spec);
  ThreadPool pool(1);
  SceneBuilder scene(SceneParams{}, FrameLimits{}, pool);
  Outcome outcome;
  for (std::size_t k = 0; k < frames; ++k) {
    Frame frame = simulation.MakeFrame(k);
    for (ObjectMotion& motion : frame.motions) {
      if (inverse) motion.H_W = Inverse(motion.H_W);
    }
    const auto report = scene.Apply(frame);
    EXPECT_TRUE(report.ok()) << report.status();
    if (report.ok()) outcome.left_out += report->motions_implausible;
  }
  outcome.length_m = scene.Publish()->FindObject(1)->solid->box_O.Size().x();
  return outcome;
}

TEST(InverseMotions, AreNamedWhereFewRaysMeetTheModel) {
  const Outcome outcome = After(25, true);
  EXPECT_GE(outcome.left_out, 4u);
  EXPECT_LT(outcome.length_m, 23);
}

TEST(InverseMotions, RightOnesAreNot) {
  const Outcome outcome = After(25, false);
  EXPECT_EQ(outcome.left_out, 0u);
  EXPECT_NEAR(outcome.length_m, 4, 0.3);
}

}  // namespace
}  // namespace clearway
