#include "clearway/planning/arm.h"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <random>

namespace clearway {
namespace {

namespace ob = ompl::base;

// Joints that turn about the z and y axes in turn, half a metre of arm to each.
struct ThreeJoints {
  ThreeJoints() {
    robot.name = "arm";
    for (const char* name : {"base", "one", "two", "three"}) {
      robot.links.push_back({name, {{Box{{0.5, 0.1, 0.1}}, Pose::Translation(0.25, 0, 0)}}});
    }
    for (int i = 0; i < 3; ++i) {
      Joint joint;
      joint.T_P_J = Pose::Translation(i == 0 ? 0 : 0.5, 0, 0);
      joint.axis_J = i % 2 == 0 ? Eigen::Vector3d(0, 0, 2) : Eigen::Vector3d(0, 1, 0);
      joint.min_rad = -3;
      joint.max_rad = 3;
      joint.max_radps = 1;
      arm.joints.push_back(joint);
    }
    arm.T_W_B = Pose::Translation(1, 2, 3);
    space->setBounds(-3, 3);
  }
  std::vector<Pose> At(const ob::State* state) const {
    StateBatch batch;
    EXPECT_TRUE(ArmMapping(robot, arm, FixedTime{}).Append(state, batch).ok());
    return batch.T_W_L;
  }

  Robot robot;
  ArmSpace arm;
  std::shared_ptr<ob::RealVectorStateSpace> space = std::make_shared<ob::RealVectorStateSpace>(3);
};

TEST(ArmMapping, LinksTurnAboutTheJointsBeforeThem) {
  const ThreeJoints world;
  ob::ScopedState<> state(world.space);
  state = std::vector<double>{M_PI / 2, 0, 0};
  const std::vector<Pose> straight = world.At(state.get());
  ASSERT_EQ(straight.size(), 4u);
  EXPECT_EQ(straight[0], world.arm.T_W_B);
  EXPECT_LT((straight[3] * Eigen::Vector3d(0.5, 0, 0) - Eigen::Vector3d(1, 3.5, 3)).norm(), 1e-12);
  state = std::vector<double>{0, -M_PI / 2, M_PI / 2};
  const std::vector<Pose> up = world.At(state.get());
  EXPECT_LT((up[2] * Eigen::Vector3d(0.5, 0, 0) - Eigen::Vector3d(1.5, 2, 3.5)).norm(), 1e-12);
  EXPECT_LT((up[3] * Eigen::Vector3d(0.5, 0, 0) - Eigen::Vector3d(1.5, 2.5, 3.5)).norm(), 1e-12);
}

// By brute force: corners of the links on the way, beside where they would be if each link went
// straight and turned evenly.
TEST(ArmMapping, PointsStrayNoFartherThanSaid) {
  const ThreeJoints world;
  const StateMapping dut = ArmMapping(world.robot, world.arm, FixedTime{});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-3, 3), step(-0.4, 0.4);
  double closest = 0;
  for (int motion = 0; motion < 300; ++motion) {
    ob::ScopedState<> from(world.space), to(world.space), between(world.space);
    for (int i = 0; i < 3; ++i) {
      from[i] = any(random);
      to[i] = std::clamp(from[i] + step(random), -3.0, 3.0);
    }
    std::vector<Pose> ends = world.At(from.get());
    const std::vector<Pose> last = world.At(to.get());
    ends.insert(ends.end(), last.begin(), last.end());
    std::vector<double> deviations_m;
    dut.AppendDeviations(from.get(), to.get(), ends, deviations_m);
    ASSERT_EQ(deviations_m.size(), 4u);
    for (int k = 1; k < 20; ++k) {
      const double share = k / 20.0;
      world.space->interpolate(from.get(), to.get(), share, between.get());
      const std::vector<Pose> there = world.At(between.get());
      for (std::size_t link = 0; link < 4; ++link) {
        const Pose even{ends[link].rotation.slerp(share, last[link].rotation),
                        (1 - share) * ends[link].translation + share * last[link].translation};
        for (const double z : {-0.05, 0.05}) {
          const Eigen::Vector3d corner(0.5, 0.05, z);
          const double strays_m = (there[link] * corner - even * corner).norm();
          ASSERT_LE(strays_m, deviations_m[link] + 1e-12);
          if (link > 0) closest = std::max(closest, strays_m / deviations_m[link]);
        }
      }
    }
  }
  EXPECT_GT(closest, 0.2);  // the bound is not idle
}

TEST(ArmMapping, NoPointGoesFartherThanTheMotionBound) {
  const ThreeJoints world;
  const StateMapping dut = ArmMapping(world.robot, world.arm, FixedTime{});
  ob::ScopedState<> from(world.space), to(world.space);
  from = std::vector<double>{0, 0, 0};
  to = std::vector<double>{0.1, 0, 0};
  const auto bound_m = dut.MotionBoundMetres(from.get(), to.get());
  ASSERT_TRUE(bound_m);
  EXPECT_GE(*bound_m, 0.1 * Eigen::Vector2d(1.5, 0.05).norm());
  EXPECT_LT(*bound_m, 0.1 * 1.7);
}

}  // namespace
}  // namespace clearway
