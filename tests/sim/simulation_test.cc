#include "clearway/sim/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "clearway/sim/scenarios.h"

namespace clearway {
namespace {

bool SameBytes(const Frame& a, const Frame& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
  };
  const auto same_motion = [](const ObjectMotion& x, const ObjectMotion& y) {
    return x.id == y.id && x.H_W == y.H_W && x.from == y.from;
  };
  const auto same_pose = [](const ObjectPose& x, const ObjectPose& y) {
    return x.id == y.id && x.T_W_B == y.T_W_B;
  };
  return a.sensor_id == b.sensor_id && a.sequence == b.sequence && a.stamp == b.stamp &&
         a.T_W_S == b.T_W_S && same(a.points_S, b.points_S) && same(a.labels, b.labels) &&
         same(a.no_return, b.no_return) && same(a.origins_S, b.origins_S) &&
         std::equal(a.motions.begin(), a.motions.end(), b.motions.begin(), b.motions.end(),
                    same_motion) &&
         std::equal(a.poses.begin(), a.poses.end(), b.poses.begin(), b.poses.end(), same_pose);
}

Simulation Small(const ScenarioOptions& options = {}) { return *MakeScenario("small", options); }

ScenarioOptions Noisy(std::uint64_t seed) {
  return {.seed = seed, .noise = SlamNoise::TableOne(), .range_noise_m = 0.02};
}

TEST(SimulationTest, EmptyWorldMakesEmptyFrames) {
  const Simulation dut{SimulationSpec{}};
  const Frame frame = dut.MakeFrame(0);
  EXPECT_TRUE(frame.points_S.empty());
  EXPECT_TRUE(frame.motions.empty());
  EXPECT_TRUE(Validate(frame, FrameLimits()).ok());
}

TEST(SimulationTest, FramesAreWellFormed) {
  for (const ObjectReport report :
       {ObjectReport::kMotions, ObjectReport::kPoses, ObjectReport::kNothing}) {
    ScenarioOptions options = Noisy(3);
    options.report = report;
    options.keep_no_return = true;
    const Simulation dut = Small(options);
    for (std::size_t k = 0; k < dut.frame_count(); ++k) {
      const Frame frame = dut.MakeFrame(k);
      EXPECT_TRUE(Validate(frame, FrameLimits()).ok()) << Validate(frame, FrameLimits());
      EXPECT_EQ(frame.sequence, k);
    }
  }
}

TEST(SimulationTest, SameSeedSameBytesInAnyOrder) {
  const Simulation a = Small(Noisy(5)), b = Small(Noisy(5));
  std::vector<Frame> forward;
  for (std::size_t k = 0; k < a.frame_count(); ++k) forward.push_back(a.MakeFrame(k));
  for (std::size_t k = b.frame_count(); k-- > 0;) {
    EXPECT_TRUE(SameBytes(b.MakeFrame(k), forward[k])) << k;
  }
}

TEST(SimulationTest, AnotherSeedIsAnotherRun) {
  const Frame a = Small(Noisy(5)).MakeFrame(4), b = Small(Noisy(6)).MakeFrame(4);
  EXPECT_FALSE(a.T_W_S == b.T_W_S);
  EXPECT_FALSE(a.motions[0].H_W == b.motions[0].H_W);
  EXPECT_NE(a.points_S[0], b.points_S[0]);
}

TEST(SimulationTest, WithoutNoiseTheSeedDoesNotMatter) {
  EXPECT_TRUE(SameBytes(Small({.seed = 1}).MakeFrame(4), Small({.seed = 2}).MakeFrame(4)));
}

// Whether the body's surface passes within `margin_m` of the point: some of the points around it
// are inside and some are not.
bool OnSurface(const Body& body, const Eigen::Vector3d& p_W, Time t, double margin_m) {
  const World alone({body});
  const WorldAtTime truth(alone, t);
  bool inside = false, outside = false;
  for (int i = 0; i < 343; ++i) {
    const Eigen::Vector3d offset(i % 7 - 3, i / 7 % 7 - 3, i / 49 - 3);
    (truth.ObjectAt(p_W + margin_m / 3 * offset) ? inside : outside) = true;
    if (inside && outside) return true;
  }
  return false;
}

TEST(SimulationTest, EveryPointLiesOnASurfaceOfItsLabel) {
  const Simulation dut = Small();
  std::set<ObjectId> seen;
  for (const std::size_t k : {0u, 7u, 19u}) {
    const Frame frame = dut.MakeFrame(k);
    for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
      const Eigen::Vector3d p_W = frame.T_W_S * frame.points_S[i].cast<double>();
      const auto bodies = dut.world().bodies();
      EXPECT_TRUE(std::any_of(bodies.begin(), bodies.end(),
                              [&](const Body& body) {
                                return body.id == frame.labels[i] &&
                                       OnSurface(body, p_W, frame.stamp, 3e-5);
                              }))
          << p_W.transpose() << " label " << frame.labels[i];
      seen.insert(frame.labels[i]);
    }
  }
  EXPECT_EQ(seen, (std::set<ObjectId>{0, 1, 2, 3}));
}

TEST(SimulationTest, NothingStandsBetweenSensorAndPoint) {
  const Simulation dut = Small();
  const Frame frame = dut.MakeFrame(11);
  const WorldAtTime truth(dut.world(), frame.stamp);
  for (std::size_t i = 0; i < frame.points_S.size(); i += 7) {
    const Eigen::Vector3d p_S = frame.points_S[i].cast<double>();
    for (double range_m = 0; range_m < p_S.norm() - 1e-3; range_m += 0.02) {
      EXPECT_EQ(truth.ObjectAt(frame.T_W_S * (range_m * p_S.normalized())), std::nullopt);
    }
  }
}

TEST(SimulationTest, ExactMotionsLeadFromFrameToFrame) {
  const Simulation dut = Small();
  EXPECT_TRUE(dut.MakeFrame(0).motions.empty());
  for (std::size_t k = 1; k < dut.frame_count(); ++k) {
    const Frame frame = dut.MakeFrame(k);
    ASSERT_EQ(frame.motions.size(), 3u);
    for (const ObjectMotion& motion : frame.motions) {
      EXPECT_EQ(motion.from, dut.StampOf(k - 1));
      const Pose moved = motion.H_W * *dut.world().T_W_B(motion.id, motion.from);
      const Pose expected = *dut.world().T_W_B(motion.id, frame.stamp);
      EXPECT_LT((moved.translation - expected.translation).norm(), 1e-9);
      EXPECT_LT(moved.rotation.angularDistance(expected.rotation), 1e-9);
    }
  }
}

TEST(SimulationTest, PosesAreReportedIfAskedFor) {
  const Simulation dut = Small({.report = ObjectReport::kPoses});
  const Frame frame = dut.MakeFrame(3);
  EXPECT_TRUE(frame.motions.empty());
  ASSERT_EQ(frame.poses.size(), 3u);
  for (const ObjectPose& pose : frame.poses) {
    EXPECT_EQ(pose.T_W_B, *dut.world().T_W_B(pose.id, frame.stamp));
  }
}

TEST(SimulationTest, OnlyVisibleObjectsAreReportedIfAskedFor) {
  SimulationSpec spec = Small({.report_visible_only = true}).spec();
  spec.world.Add(Body::Single(9, "far away", Sphere{1}, FixedPose{Pose::Translation(500, 0, 0)}));
  EXPECT_EQ(Simulation(spec).MakeFrame(2).motions.size(), 3u);
  spec.report_visible_only = false;
  EXPECT_EQ(Simulation(spec).MakeFrame(2).motions.size(), 4u);
}

TEST(SimulationTest, NoisyMotionsHaveTheObjectsMeanErrors) {
  const ScenarioOptions options{.noise = SlamNoise::TableOne(), .frame_count = 400};
  const Simulation dut = Small(options);
  double pose_m = 0, motion_m = 0, camera_m = 0;
  for (std::size_t k = 1; k < dut.frame_count(); ++k) {
    const Pose truth = *dut.world().T_W_B(2, dut.StampOf(k));
    const Pose last_truth = *dut.world().T_W_B(2, dut.StampOf(k - 1));
    const Pose H_W = *dut.ReportedT_W_B(2, k) * Inverse(*dut.ReportedT_W_B(2, k - 1));
    // In the object's frame, so that its distance from the world's origin plays no part.
    const Pose error = Inverse(truth) * (H_W * last_truth);
    motion_m += error.translation.norm() / 399;
    pose_m += (Inverse(truth) * *dut.ReportedT_W_B(2, k)).translation.norm() / 399;
    camera_m += (Inverse(dut.TrueT_W_S(k)) * dut.ReportedT_W_S(k)).translation.norm() / 399;
  }
  EXPECT_NEAR(pose_m, 0.57, 0.01);
  EXPECT_NEAR(motion_m, 0.54, 0.06);
  EXPECT_NEAR(camera_m, 0.29, 0.01);
}

TEST(SimulationTest, FramesCarryTheReportedPosesAndMotions) {
  const Simulation dut = Small(Noisy(2));
  const Frame frame = dut.MakeFrame(6);
  EXPECT_EQ(frame.T_W_S, dut.ReportedT_W_S(6));
  for (const ObjectMotion& motion : frame.motions) {
    const Pose moved = motion.H_W * *dut.ReportedT_W_B(motion.id, 5);
    EXPECT_LT((moved.translation - dut.ReportedT_W_B(motion.id, 6)->translation).norm(), 1e-9);
  }
}

TEST(SimulationTest, FramesFromAnotherPoseAreThoseOfASensorThatStandsThere) {
  const Simulation dut = Small(Noisy(2));
  const Pose T_W_S = dut.TrueT_W_S(0) * Pose::Translation(0.3, -0.2, 0.1);
  SimulationSpec spec = dut.spec();
  spec.sensor_trajectory = FixedPose{T_W_S};
  const Simulation stands(spec);
  for (const std::size_t k : {0u, 3u}) {
    EXPECT_TRUE(SameBytes(dut.MakeFrameFrom(T_W_S, k), stands.MakeFrame(k))) << k;
    EXPECT_TRUE(SameBytes(dut.MakeFrameFrom(dut.TrueT_W_S(k), k), dut.MakeFrame(k))) << k;
  }
}

TEST(SimulationTest, SlamNoiseLeavesThePointsInTheSensorFrameAlone) {
  const Frame exact = Small().MakeFrame(8);
  const Frame noisy = Small({.noise = SlamNoise::TableOne()}).MakeFrame(8);
  EXPECT_EQ(exact.points_S, noisy.points_S);
}

TEST(SimulationTest, RangeNoiseIsAlongTheRay) {
  const Frame exact = Small().MakeFrame(8);
  const Frame noisy = Small({.range_noise_m = 0.05}).MakeFrame(8);
  ASSERT_EQ(exact.points_S.size(), noisy.points_S.size());
  double sum = 0, squares = 0;
  const auto count = static_cast<double>(exact.points_S.size());
  for (std::size_t i = 0; i < exact.points_S.size(); ++i) {
    const Eigen::Vector3d a = exact.points_S[i].cast<double>();
    const Eigen::Vector3d b = noisy.points_S[i].cast<double>();
    EXPECT_LT(a.cross(b).norm() / a.norm(), 1e-5);
    sum += b.norm() - a.norm();
    squares += (b.norm() - a.norm()) * (b.norm() - a.norm());
  }
  EXPECT_NEAR(sum / count, 0, 0.005);
  EXPECT_NEAR(std::sqrt(squares / count), 0.05, 0.005);
}

TEST(SimulationTest, RaysWithoutAReturnAreKeptAtTheMaximumRangeIfAskedFor) {
  const Simulation dut = Small({.keep_no_return = true});
  const Frame frame = dut.MakeFrame(5);
  ASSERT_EQ(frame.no_return.size(), frame.points_S.size());
  EXPECT_EQ(frame.points_S.size(), RayDirections(dut.spec().sensor).size());
  std::size_t marked = 0;
  for (std::size_t i = 0; i < frame.points_S.size(); ++i) {
    if (frame.no_return[i] == 0) continue;
    ++marked;
    EXPECT_EQ(frame.labels[i], kStaticLabel);
    EXPECT_NEAR(frame.points_S[i].norm(), MaxRangeM(dut.spec().sensor), 1e-5);
  }
  const Frame without = Small().MakeFrame(5);
  EXPECT_TRUE(without.no_return.empty());
  EXPECT_GT(marked, 0u);
  EXPECT_EQ(without.points_S.size() + marked, frame.points_S.size());
}

TEST(SimulationTest, ARayBlockedTooNearYieldsNothing) {
  SimulationSpec spec;
  spec.sensor = SpinningLidar{.beams = 1,
                              .azimuth_steps = 16,
                              .lowest_rad = 0,
                              .first_azimuth_rad = -0.3,
                              .azimuth_span_rad = 0.6,
                              .min_range_m = 1};
  spec.keep_no_return = true;
  spec.world.Add(Body::Single(0, "far", Box{{0.1, 9, 9}}, FixedPose{Pose::Translation(4, 0, 0)}));
  spec.world.Add(
      Body::Single(0, "near", Box{{0.1, 9, 9}}, FixedPose{Pose::Translation(0.5, 0, 0)}));
  EXPECT_TRUE(Simulation(spec).MakeFrame(0).points_S.empty());
}

TEST(SimulationTest, FrameSourceOutlivesItsSimulation) {
  FrameSource source;
  Frame expected;
  {
    const Simulation dut = Small(Noisy(1));
    source = dut.Frames();
    expected = dut.MakeFrame(9);
  }
  EXPECT_EQ(source.frame_count, 20u);
  EXPECT_EQ(source.resolution_m, 0.1);
  EXPECT_TRUE(SameBytes(*source.read(9), expected));
}

TEST(SimulationTest, ReadingPastTheEndIsRefused) {
  const FrameSource source = Small().Frames();
  EXPECT_EQ(source.read(20).status().code(), absl::StatusCode::kOutOfRange);
}

}  // namespace
}  // namespace clearway
