// Robots of closed meshes, whichever way their faces are turned, against an oracle that knows the
// solid.
#include "collision/random_solids.h"

#include <gtest/gtest.h>

#include <iostream>

#include "clearway/collision/scene_checker.h"
#include "collision/test_world.h"

namespace clearway {
namespace {

using testing_support::Random;

constexpr double kVoxel_m = 0.05;

SpaceStatus StatusWith(const std::shared_ptr<const PreparedRobot>& robot, const Pose& T_W_L,
                       const Eigen::Vector3d& obstacle_W) {
  SceneParams params;
  params.resolution_m = kVoxel_m;
  const VoxelGrid grid(kVoxel_m);
  const Eigen::Vector3d center_W = grid.CenterOf(grid.KeyOf(obstacle_W));
  const ScenePtr scene = TestWorld(params).Occupied({center_W, center_W}).Scene();
  CheckOptions options;
  options.unknown = UnknownPolicy::kFree;
  const auto reply = SceneChecker(scene, robot).Check(OneState(T_W_L), options);
  return reply.ok() ? reply->answers[0].status : SpaceStatus::kUnresolved;
}

struct Counts {
  int inside = 0, inside_free = 0;
  int outside = 0, outside_free = 0;
};

// One obstacle in the solid and one more than a voxel outside of it, for each of the meshes.
Counts CheckSolids(int count, unsigned seed) {
  Random random(seed);
  Counts counts;
  for (int i = 0; i < count; ++i) {
    const RandomSolid solid = AnySolid(random);
    const Mesh damaged = Damaged(solid.Joined(), random);
    const auto robot = std::make_shared<const PreparedRobot>(
        Robot::SingleShape("robot", TriangleMesh{std::make_shared<const Mesh>(damaged)}));
    const Pose T_W_L = random.AnyPose(2), T_L_W = Inverse(T_W_L);
    const Aabb box_L = BoundingBox(robot->robot().links[0].shapes[0].shape).Padded(3 * kVoxel_m);
    const VoxelGrid grid(kVoxel_m);
    bool has_inside = false, has_outside = false;
    for (int attempt = 0; attempt < 300 && !(has_inside && has_outside); ++attempt) {
      const Eigen::Vector3d part = 0.5 * (random.Vector(1).array() + 1);
      const Eigen::Vector3d p_L = box_L.min + box_L.Size().cwiseProduct(part);
      const Eigen::Vector3d p_W = T_W_L * p_L;
      if (!has_inside && solid.Contains(p_L)) {
        has_inside = true;
        ++counts.inside;
        const bool is_free = StatusWith(robot, T_W_L, p_W) == SpaceStatus::kFree;
        counts.inside_free += is_free;
        EXPECT_FALSE(is_free) << "solid " << i << ", a " << solid.kind;
      }
      const Eigen::Vector3d center_L = T_L_W * grid.CenterOf(grid.KeyOf(p_W));
      if (!has_outside && solid.DistanceTo(center_L) > (1 + std::sqrt(0.75)) * kVoxel_m) {
        has_outside = true;
        ++counts.outside;
        counts.outside_free += StatusWith(robot, T_W_L, p_W) == SpaceStatus::kFree;
      }
    }
  }
  std::cout << counts.inside_free << " of " << counts.inside << " free with an obstacle inside, "
            << counts.outside_free << " of " << counts.outside << " with one outside\n";
  return counts;
}

void ExpectRightAnswers(int solids, unsigned seed) {
  const Counts counts = CheckSolids(solids, seed);
  EXPECT_GT(counts.inside, 0.98 * solids);
  EXPECT_EQ(counts.inside_free, 0);
  EXPECT_GT(counts.outside, 0.98 * solids);
  EXPECT_GE(counts.outside_free, 0.99 * counts.outside);
}

TEST(RandomSolidsTest, NoneIsFreeWithAnObstacleInside) { ExpectRightAnswers(1'000, 55); }

// Takes minutes: `./dev long` runs it.
TEST(RandomSolidsTest, DISABLED_NoneOfTenThousandIsFree) { ExpectRightAnswers(10'000, 56); }

}  // namespace
}  // namespace clearway
