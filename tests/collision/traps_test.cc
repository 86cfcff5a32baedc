// The traps of FCL and of its octrees that made the broad phase our own: each must not catch us.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "clearway/collision/scene_checker.h"
#include "collision/contact_if_thrown.h"
#include "collision/random_world.h"
#include "collision/test_world.h"
#include "collision/voxel_search.h"

namespace clearway {
namespace {

CheckReply Check(const TestWorld& world, Robot robot, const StateBatch& states,
                 const CheckOptions& options) {
  const auto reply = SceneChecker(world.Scene(), std::move(robot)).Check(states, options);
  EXPECT_TRUE(reply.ok()) << reply.status();
  return reply.value_or(CheckReply{});
}

CheckOptions ClearanceOnly(double up_to_m) {
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  options.clearance_up_to_m = up_to_m;
  return options;
}

// An fcl::OcTree's box is its whole address space, so that no broad phase prunes it.
TEST(TrapsTest, OnlyVoxelsAtTheShapeAreLookedAt) {
  const ScenePtr scene = TestWorld().Occupied({{-5, -5, -1}, {5, 5, 1}}).Scene();
  const VoxelMap& map = scene->static_map_W;
  KeyRange keys;
  ASSERT_TRUE(KeysTouching(map.grid(), {{0.05, 0.05, 0.05}, {0.25, 0.15, 0.05}}, keys));
  int seen = 0;
  map.blocks().ForEachIn(
      BlockOf(keys.min), BlockOf(keys.max), [&](BlockKey key, const VoxelBlock& block) {
        RangeInBlock(key, keys).All().ForEach([&](int i) { seen += block.occupied.Test(i); });
      });
  EXPECT_EQ(seen, 3 * 2 * 1);
}

// In an fcl::OcTree a node that was never observed counts as free.
TEST(TrapsTest, UnknownIsNotFree) {
  const auto reply = Check(TestWorld(), Robot::SingleShape("ball", Sphere{0.2}), At(0, 0, 0), {});
  EXPECT_EQ(reply.answers[0].status, SpaceStatus::kUnknownSpace);
}

// FCL's conservative advancement has no octrees: it says "no collision" and warns on stderr.
TEST(TrapsTest, NothingIsSaidOnStderr) {
  RandomWorld random(5);
  ::testing::internal::CaptureStderr();
  for (std::size_t kind = 0; kind < std::variant_size_v<Shape>; ++kind) {
    const ScenePtr scene = random.Scene();
    const Robot robot = Robot::SingleShape("r", random.ShapeOfKind(kind));
    CheckOptions options = ClearanceOnly(0.5);
    ASSERT_TRUE(SceneChecker(scene, robot).Check(random.States(robot, 20), options).ok());
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// FCL's continuousCollide samples ten poses of the translation: a bar that turns on the spot is
// never seen to move. Here a motion is a batch, and every state's own rotation counts.
TEST(TrapsTest, TurningOnTheSpotIsSeen) {
  const TestWorld world = TestWorld().Occupied({{0, 0.8, 0}, {0.1, 0.9, 0.1}});
  StateBatch turn;
  for (int degrees = 0; degrees <= 180; degrees += 5) {
    turn.times.push_back(kTestStart);
    turn.T_W_L.push_back({Eigen::Quaterniond(Eigen::AngleAxisd(degrees * std::numbers::pi / 180,
                                                               Eigen::Vector3d::UnitZ())),
                          Eigen::Vector3d(0, 0, 0.05)});
  }
  const auto reply =
      Check(world, Robot::SingleShape("bar", Box{{2, 0.1, 0.1}}), turn, ClearanceOnly(1));
  EXPECT_EQ(reply.answers.front().status, SpaceStatus::kFree);
  EXPECT_EQ(reply.answers[90 / 5].status, SpaceStatus::kOccupied);
  EXPECT_EQ(reply.answers.back().status, SpaceStatus::kFree);
}

// Distances to octrees are reported wrong upstream.
TEST(TrapsTest, DistancesToVoxelsAreRight) {
  RandomWorld random(9);
  for (int i = 0; i < 200; ++i) {
    TestWorld world;
    const Eigen::Vector3d near_center = random.Point({{-3, -3, -3}, {3, 3, 3}});
    world.Occupied({near_center.array() - 0.051, near_center.array() + 0.051});
    const Aabb voxels = world.Scene()->static_map_W.OccupiedBox();
    ASSERT_FALSE(voxels.Empty());
    const Eigen::Vector3d p = random.Point({{-3, -3, -3}, {3, 3, 3}});
    const double expected_m = (p - p.cwiseMax(voxels.min).cwiseMin(voxels.max)).norm() - 0.1;
    const auto reply = Check(world, Robot::SingleShape("ball", Sphere{0.1}),
                             At(p.x(), p.y(), p.z()), ClearanceOnly(20));
    EXPECT_NEAR(*reply.answers[0].clearance_m, std::max(0.0, expected_m), 1e-9);
  }
}

// FCL's distance crashes on an empty octree.
TEST(TrapsTest, AnEmptySceneHasAClearance) {
  for (UnknownPolicy unknown :
       {UnknownPolicy::kFree, UnknownPolicy::kTolerated, UnknownPolicy::kBlocked}) {
    CheckOptions options = ClearanceOnly(5);
    options.unknown = unknown;
    const auto reply =
        Check(TestWorld(), Robot::SingleShape("ball", Sphere{0.1}), At(0, 0, 0), options);
    EXPECT_EQ(reply.answers[0].clearance_m, unknown == UnknownPolicy::kBlocked ? 0.0 : 5.0);
  }
}

// An object without occupied voxels has no hull to make a body of.
TEST(TrapsTest, AnObjectWithoutVoxelsIsNowhere) {
  const TestWorld world = TestWorld().Object(1, {}, Pose{});
  const auto reply =
      Check(world, Robot::SingleShape("ball", Sphere{0.1}), At(0, 0, 0), ClearanceOnly(5));
  EXPECT_EQ(reply.answers[0].status, SpaceStatus::kFree);
  EXPECT_EQ(reply.answers[0].clearance_m, 5.0);
}

// A search for unknown space must end where all space is declared free.
TEST(TrapsTest, AWorldDeclaredFreeHasAClearance) {
  CheckOptions options;
  options.clearance_up_to_m = 1e5;
  options.known_free_W = {Aabb{{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}}};
  const auto reply =
      Check(TestWorld(), Robot::SingleShape("ball", Sphere{0.1}), At(0, 0, 0), options);
  EXPECT_EQ(reply.answers[0].status, SpaceStatus::kFree);
  EXPECT_EQ(reply.answers[0].clearance_m, 1e5);
}

// Nor may it look at every block where the boxes that declare it free touch.
TEST(TrapsTest, AWorldDeclaredFreeInPartsHasAClearance) {
  CheckOptions options;
  options.clearance_up_to_m = 1e5;
  options.known_free_W = {Aabb{{-1e6, -1e6, -1e6}, {0.43, 1e6, 1e6}},
                          Aabb{{0.43, -1e6, 0.21}, {1e6, 1e6, 1e6}},
                          Aabb{{0.43, -1e6, -1e6}, {1e6, 1e6, 0.22}}};
  const auto reply =
      Check(TestWorld(), Robot::SingleShape("ball", Sphere{0.1}), At(0, 0, 0), options);
  EXPECT_EQ(reply.answers[0].status, SpaceStatus::kFree);
  EXPECT_EQ(reply.answers[0].clearance_m, 1e5);
  options.known_free_W[2].max.z() = 0.04;  // leaves a gap with voxels in it
  const auto with_gap =
      Check(TestWorld(), Robot::SingleShape("ball", Sphere{0.1}), At(0, 0, 0), options);
  EXPECT_LT(*with_gap.answers[0].clearance_m, 1);
}

TEST(TrapsTest, AnExceptionOfLibccdMeansContact) {
  EXPECT_EQ(ContactIfThrown([]() -> double { throw std::logic_error("libccd gave up"); }), 0);
  EXPECT_EQ(ContactIfThrown([] { return 1.5; }), 1.5);
}

}  // namespace
}  // namespace clearway
