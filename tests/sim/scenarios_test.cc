#include "clearway/sim/scenarios.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace clearway {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

// The robot of a task, standing on the ground at p_W with the given heading.
std::optional<ObjectId> RobotTouches(const World& world, const CrossingTask& task,
                                     const Eigen::Vector3d& p_W, double yaw_rad, Time t) {
  const Pose T_W_R{Exp({{0, 0, yaw_rad}, Eigen::Vector3d::Zero()}).rotation,
                   p_W + Eigen::Vector3d(0, 0, task.robot_size_m.z() / 2)};
  return world.Touched(Box{task.robot_size_m}, T_W_R, t);
}

// What the robot first touches on straight lines through the points at full speed, from `start` on.
std::optional<ObjectId> FirstTouched(const World& world, const CrossingTask& task,
                                     const std::vector<Eigen::Vector3d>& points_W, Time start) {
  double seconds = 0;
  for (std::size_t i = 0; i + 1 < points_W.size(); ++i) {
    const Eigen::Vector3d way = points_W[i + 1] - points_W[i];
    for (double s = 0; s <= way.norm(); s += 0.02) {
      const Time t = start + FromSeconds(seconds + s / task.max_speed_mps);
      const Eigen::Vector3d p_W = points_W[i] + s * way.normalized();
      if (auto id = RobotTouches(world, task, p_W, std::atan2(way.y(), way.x()), t)) return id;
    }
    seconds += way.norm() / task.max_speed_mps;
  }
  return std::nullopt;
}

// The world without one object.
World Without(const World& world, ObjectId id) {
  World others;
  for (const Body& body : world.bodies()) {
    if (body.id != id) others.Add(body);
  }
  return others;
}

// Checks that no object drives into anything while the sensor might see it.
void ExpectNoAccidents(const Simulation& simulation, double within_m) {
  for (const ObjectId id : simulation.world().ObjectIds()) {
    const World others = Without(simulation.world(), id);
    const Body& body = *simulation.world().FindObject(id);
    for (std::size_t k = 0; k < simulation.frame_count(); k += 3) {
      const Time t = simulation.StampOf(k);
      const Pose T_W_B = PoseAt(body.trajectory, t);
      const double away_m = (T_W_B.translation - simulation.TrueT_W_S(k).translation).norm();
      if (away_m > within_m) continue;
      for (const BodyPart& part : body.parts) {
        ASSERT_EQ(others.Touched(part.shape, T_W_B * part.T_B_G, t), std::nullopt)
            << body.name << " " << id << " at frame " << k;
      }
    }
  }
}

// The most points that a frame has of each label, over every so many-th frame.
std::map<ObjectId, std::size_t> MostPoints(const Simulation& simulation, std::size_t stride) {
  std::map<ObjectId, std::size_t> most;
  for (std::size_t k = 0; k < simulation.frame_count(); k += stride) {
    std::map<ObjectId, std::size_t> counts;
    for (const ObjectId label : simulation.MakeFrame(k).labels) ++counts[label];
    for (const auto& [label, count] : counts) most[label] = std::max(most[label], count);
  }
  return most;
}

TEST(ScenariosTest, EveryNameMakesFrames) {
  EXPECT_THAT(ScenarioNames(), ElementsAre("crossing", "street", "lab", "small", "occlusions",
                                           "queues", "swaps", "far_swaps", "articulated"));
  for (const std::string& name : ScenarioNames()) {
    const auto dut = MakeScenario(name);
    ASSERT_TRUE(dut.ok());
    const Frame frame = dut->MakeFrame(dut->frame_count() - 1);
    EXPECT_TRUE(Validate(frame, FrameLimits()).ok());
    EXPECT_GT(frame.points_S.size(), 1'000u);
    EXPECT_EQ(frame.sensor_id, name);
    EXPECT_GT(frame.motions.size(), 0u);
  }
}

TEST(ScenariosTest, OptionsReachTheSensor) {
  const auto lidar = MakeScenario("crossing", {.beams = 16, .azimuth_steps = 100});
  EXPECT_EQ(RayDirections(lidar->spec().sensor).size(), 1'600u);
  const auto camera = MakeScenario("lab", {.image_width_px = 80});
  EXPECT_EQ(RayDirections(camera->spec().sensor).size(), 80u * 60u);
  EXPECT_EQ(MakeScenario("lab", {.frame_count = 7})->frame_count(), 7u);
}

TEST(CrossingTest, TheStraightLineAtFullSpeedHitsAVehicle) {
  const auto dut = MakeScenario("crossing");
  const CrossingTask& task = dut->spec().tasks.at(0);
  EXPECT_EQ(task.robot_size_m, Eigen::Vector3d(1.0, 0.7, 1.0));
  EXPECT_EQ(task.max_speed_mps, 2);
  const Time start = dut->StampOf(task.planning_frame);
  EXPECT_THAT(FirstTouched(dut->world(), task, {task.start_W, task.goal_W}, start),
              Optional(task.blocker));
}

TEST(CrossingTest, StartAndGoalAreFreeForAsLongAsTheTaskLasts) {
  const auto dut = MakeScenario("crossing");
  const CrossingTask& task = dut->spec().tasks.at(0);
  for (double s = 0; s <= ToSeconds(task.time_limit); s += 0.05) {
    const Time t = dut->StampOf(task.planning_frame) + FromSeconds(s);
    EXPECT_EQ(RobotTouches(dut->world(), task, task.start_W, std::numbers::pi / 2, t),
              std::nullopt);
    EXPECT_EQ(RobotTouches(dut->world(), task, task.goal_W, std::numbers::pi / 2, t), std::nullopt);
  }
}

TEST(CrossingTest, WaitingLeavesAWay) {
  const auto dut = MakeScenario("crossing");
  const CrossingTask& task = dut->spec().tasks.at(0);
  int ways = 0;
  for (double wait_s = 0; wait_s <= 5; wait_s += 0.1) {
    const Time start = dut->StampOf(task.planning_frame) + FromSeconds(wait_s);
    ways += !FirstTouched(dut->world(), task, {task.start_W, task.goal_W}, start);
  }
  EXPECT_GE(ways, 5);
}

TEST(CrossingTest, GoingRoundLeavesAWay) {
  const auto dut = MakeScenario("crossing");
  const CrossingTask& task = dut->spec().tasks.at(0);
  const Time start = dut->StampOf(task.planning_frame);
  int ways = 0;
  for (double x = -5; x <= 5; x += 0.5) {
    for (double y = -4; y <= 2; y += 0.5) {
      ways += !FirstTouched(dut->world(), task, {task.start_W, {x, y, 0}, task.goal_W}, start);
    }
  }
  EXPECT_GE(ways, 5);
}

TEST(CrossingTest, EveryoneIsSeenBeforeThePlanIsMade) {
  const auto dut = MakeScenario("crossing");
  for (const std::size_t k : {20u, 25u, 30u}) {
    std::map<ObjectId, int> counts;
    for (const ObjectId label : dut->MakeFrame(k).labels) ++counts[label];
    for (const ObjectId id : dut->world().ObjectIds()) EXPECT_GT(counts[id], 20) << id;
  }
}

TEST(CrossingTest, NobodyRunsIntoAnything) { ExpectNoAccidents(*MakeScenario("crossing"), 60); }

TEST(StreetTest, DrivesFourHundredAndEightyMetres) {
  const auto dut = MakeScenario("street");
  const auto& drive = std::get<Drive>(dut->spec().sensor_trajectory);
  EXPECT_NEAR(LengthOf(drive), 480, 1e-9);
  double length_m = 0;
  for (std::size_t k = 1; k < dut->frame_count(); ++k) {
    length_m += (dut->TrueT_W_S(k).translation - dut->TrueT_W_S(k - 1).translation).norm();
  }
  EXPECT_NEAR(length_m, 480, 0.5);  // chords of the bends
}

TEST(StreetTest, PassesFourteenMovingObjects) {
  const auto dut = MakeScenario("street");
  const std::vector<ObjectId> ids = dut->world().ObjectIds();
  ASSERT_EQ(ids.size(), 14u);
  const auto most = MostPoints(*dut, 10);
  for (const ObjectId id : ids) {
    EXPECT_GE(most.count(id) ? most.at(id) : 0, 60u) << id;
    double way_m = 0;
    for (std::size_t k = 1; k < dut->frame_count(); ++k) {
      way_m += (dut->world().T_W_B(id, dut->StampOf(k))->translation -
                dut->world().T_W_B(id, dut->StampOf(k - 1))->translation)
                   .norm();
    }
    EXPECT_GT(way_m, 5) << id;
  }
}

TEST(StreetTest, NobodyRunsIntoAnything) { ExpectNoAccidents(*MakeScenario("street"), 90); }

TEST(StreetTest, TheSensorsOwnCarHasItsWay) {
  const auto dut = MakeScenario("street");
  const Pose T_S_car = Pose::Translation(0, 0, -1.1);
  for (std::size_t k = 0; k < dut->frame_count(); ++k) {
    EXPECT_EQ(
        dut->world().Touched(Box{{4.4, 1.8, 1.4}}, dut->TrueT_W_S(k) * T_S_car, dut->StampOf(k)),
        std::nullopt)
        << k;
  }
}

TEST(LabTest, EveryObjectIsSeenAndTurnsOrSwings) {
  const auto dut = MakeScenario("lab", {.image_width_px = 160});
  const auto most = MostPoints(*dut, 10);
  ASSERT_EQ(dut->world().ObjectIds().size(), 5u);
  for (const ObjectId id : dut->world().ObjectIds()) {
    EXPECT_GE(most.at(id), 60u) << id;
    double angle_rad = 0;
    for (std::size_t k = 1; k < dut->frame_count(); ++k) {
      angle_rad +=
          Log(*dut->world().MotionOf(id, dut->StampOf(k - 1), dut->StampOf(k))).angular.norm();
    }
    EXPECT_GT(angle_rad, 1) << id;
  }
  EXPECT_EQ(dut->spec().resolution_m, 0.05);
}

TEST(LabTest, NobodyRunsIntoAnything) { ExpectNoAccidents(*MakeScenario("lab"), 20); }

TEST(LabTest, TheCameraStaysInFreeAir) {
  const auto dut = MakeScenario("lab");
  for (std::size_t k = 0; k < dut->frame_count(); ++k) {
    EXPECT_EQ(dut->world().Touched(Sphere{0.3}, dut->TrueT_W_S(k), dut->StampOf(k)), std::nullopt);
  }
}

class HiddenTest : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Worlds, HiddenTest,
                         testing::Values("occlusions", "queues", "swaps", "far_swaps"),
                         [](const auto& world) { return std::string(world.param); });

TEST_P(HiddenTest, NobodyRunsIntoAnything) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    ExpectNoAccidents(*MakeScenario(GetParam(), {.seed = seed}), 60);
  }
}

TEST_P(HiddenTest, EverySeedIsAnotherWorld) {
  const auto place = [](std::uint64_t seed) {
    const auto simulation = MakeScenario(GetParam(), {.seed = seed});
    return simulation->world().T_W_B(1, simulation->StampOf(0))->translation;
  };
  EXPECT_EQ(place(1), place(1));
  EXPECT_GT((place(1) - place(2)).norm(), 0.1);
}

TEST(ArticulatedTest, EveryFrameTellsParts) {
  const auto dut = MakeScenario("articulated");
  const std::vector<ObjectPart> parts = dut->MakeFrame(0).parts;
  EXPECT_EQ(parts.size(), 10u);  // a trailer, eight bones, a boom
  for (const ObjectPart& part : parts) {
    EXPECT_EQ(dut->world().FindObject(part.id)->part_of, part.whole);
    EXPECT_EQ(dut->world().FindObject(part.whole)->part_of, kStaticLabel);
  }
  EXPECT_EQ(dut->world().PartsOf(3).size(), 4u);
  EXPECT_EQ(dut->world().PartsOf(3)[0]->id, 4);
  EXPECT_TRUE(dut->world().PartsOf(15).empty());
}

// What belongs together may touch; whole trucks, cyclists and excavators do not.
TEST(ArticulatedTest, NobodyRunsIntoAnything) {
  const auto dut = MakeScenario("articulated");
  for (const ObjectId id : dut->world().ObjectIds()) {
    const Body& body = *dut->world().FindObject(id);
    const ObjectId whole = body.part_of == kStaticLabel ? id : body.part_of;
    World others;
    for (const Body& other : dut->world().bodies()) {
      if (other.id != whole && (other.id == 0 || other.part_of != whole)) others.Add(other);
    }
    for (std::size_t k = 0; k < dut->frame_count(); k += 3) {
      const Time t = dut->StampOf(k);
      for (const BodyPart& part : body.parts) {
        ASSERT_EQ(others.Touched(part.shape, PoseAt(body.trajectory, t) * part.T_B_G, t),
                  std::nullopt)
            << body.name << " " << id << " at frame " << k;
      }
    }
  }
}

TEST(ArticulatedTest, PartsHangTogether) {
  const auto dut = MakeScenario("articulated");
  const auto end_of = [&](ObjectId id, Time t, double along_m) {
    return *dut->world().T_W_B(id, t) * Eigen::Vector3d(0, 0, along_m);
  };
  double most_bent_rad = 0;
  for (std::size_t k = 0; k < dut->frame_count(); k += 3) {
    const Time t = dut->StampOf(k);
    const Pose T_tractor_trailer = Inverse(*dut->world().T_W_B(1, t)) * *dut->world().T_W_B(2, t);
    // The hitch is 1.6 m behind the tractor's middle and 2.6 m before the trailer's.
    EXPECT_NEAR((T_tractor_trailer * Eigen::Vector3d(2.6, 0, 0)).x(), -1.6, 0.01) << k;
    most_bent_rad = std::max(most_bent_rad, Log(T_tractor_trailer).angular.norm());
    for (const ObjectId thigh : {4, 6, 9, 11}) {
      EXPECT_LT((end_of(thigh, t, 0.215) - end_of(thigh + 1, t, -0.215)).norm(), 0.005) << k;
    }
  }
  EXPECT_GT(most_bent_rad, 0.5);
  EXPECT_LT(most_bent_rad, 1.2);
}

TEST(ScenariosTest, UnknownNamesAreRefusedWithTheKnownOnes) {
  const auto dut = MakeScenario("motorway");
  EXPECT_EQ(dut.status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(dut.status().message(), HasSubstr("motorway"));
  EXPECT_THAT(dut.status().message(), HasSubstr("crossing, street, lab"));
}

TEST(ScenariosTest, BadOptionsAreRefusedByName) {
  const auto expect_refused = [](const char* scenario, const ScenarioOptions& options,
                                 const char* field) {
    const auto dut = MakeScenario(scenario, options);
    EXPECT_EQ(dut.status().code(), absl::StatusCode::kInvalidArgument);
    EXPECT_THAT(dut.status().message(), HasSubstr(field));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused("street", {.beams = 17}, "beams");
  expect_refused("street", {.azimuth_steps = 0}, "azimuth_steps");
  expect_refused("street", {.image_width_px = 64}, "image_width_px");
  expect_refused("lab", {.beams = 16}, "beams");
  expect_refused("lab", {.image_width_px = 3}, "image_width_px");
  expect_refused("small", {.range_noise_m = -0.1}, "range_noise_m");
  expect_refused("small", {.range_noise_m = nan}, "range_noise_m");
  expect_refused("small", {.frame_count = 0}, "frame_count");
  ScenarioOptions options;
  options.noise.object.mean_translation_m = nan;
  expect_refused("small", options, "noise.object.mean_translation_m");
}

}  // namespace
}  // namespace clearway
