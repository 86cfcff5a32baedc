// Maps of what may be one object are laid on each other by hits and by rays that pass.
#include "scene/mutual_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearway/base/thread_pool.h"
#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::BoxSurface;

constexpr double kVoxelM = 0.1;
// Its faces lie in the middle of voxels.
const Eigen::Vector3d kSizeM(3.9, 1.7, 1.3);

class MutualFitTest : public testing::Test {
 protected:
  static VoxelMap EmptyMap() { return VoxelMap(kVoxelM, OccupancyModel{}); }

  VoxelMap MapOf(const std::vector<Eigen::Vector3d>& points) {
    VoxelMap map = EmptyMap();
    ScanUpdate update;
    for (const Eigen::Vector3d& p : points) update.MarkHit(map.grid().KeyOf(p));
    map.Update(update, pool_);
    return map;
  }
  // Free in that box, from voxel to voxel.
  VoxelMap FreeIn(const Aabb& box) {
    VoxelMap map = EmptyMap();
    ScanUpdate update;
    for (double x = box.min.x(); x < box.max.x(); x += kVoxelM) {
      for (double y = box.min.y(); y < box.max.y(); y += kVoxelM) {
        for (double z = box.min.z(); z < box.max.z(); z += kVoxelM) {
          update.MarkFree(map.grid().KeyOf({x, y, z}));
        }
      }
    }
    map.Update(update, pool_);
    return map;
  }
  static std::vector<Eigen::Vector3d> Placed(const Pose& T_Y_L,
                                             std::vector<Eigen::Vector3d> points) {
    for (Eigen::Vector3d& p : points) p = T_Y_L * p;
    return points;
  }
  // Of its left side, what a sensor there sees of it, without the ends.
  static std::vector<Eigen::Vector3d> Flank() {
    std::vector<Eigen::Vector3d> points = BoxSurface(kSizeM, 0.05);
    std::erase_if(points, [](const Eigen::Vector3d& p) {
      return p.y() < kSizeM.y() / 2 - 1e-6 || p.x() > 0.5;
    });
    return points;
  }

  ThreadPool pool_{1};
};

TEST_F(MutualFitTest, LaysPointsOnTheSurface) {
  const std::vector<Eigen::Vector3d> surface = BoxSurface(kSizeM, 0.05);
  const Pose T_Y_L = Exp({{0, 0, 0.3}, {1.02, -0.37, 0.2}});
  const VoxelMap map_L = MapOf(surface), map_Y = MapOf(Placed(T_Y_L, surface));
  for (const double way : {-1, 1}) {
    const Pose guess = T_Y_L * Exp({{0, 0, way * 0.03}, {way * 0.1, way * -0.08, 0}});
    const Twist off = Log(Inverse(T_Y_L) * MutualFit(map_L, map_Y, EmptyMap(), guess));
    EXPECT_LT(off.linear.norm(), 0.03);
    EXPECT_LT(off.angular.norm(), 0.01);
  }
}

// Of a part of its side alone nobody knows where along it that is: rays that pass behind its end
// tell.
TEST_F(MutualFitTest, KeepsOutOfWhereRaysPassed) {
  const VoxelMap map_L = MapOf(BoxSurface(kSizeM, 0.05)), map_Y = MapOf(Flank());
  const double rear_m = -kSizeM.x() / 2;
  const VoxelMap around_Y = FreeIn({{rear_m - 2, -2, -1}, {rear_m - 0.15, 2, 1}});
  const Pose guess = Pose::Translation(-0.3, 0, 0);
  EXPECT_LT(MutualFit(map_L, map_Y, EmptyMap(), guess).translation.x(), -0.2);
  EXPECT_GT(MutualFit(map_L, map_Y, around_Y, guess).translation.x(), -0.15);
}

TEST_F(MutualFitTest, LeavesHeightAndTiltAsTheyAre) {
  const std::vector<Eigen::Vector3d> surface = BoxSurface(kSizeM, 0.05);
  const VoxelMap map = MapOf(surface);
  const Pose guess = Exp({{0.05, 0, 0}, {0, 0, 0.1}});
  const Pose fit = MutualFit(map, map, EmptyMap(), guess);
  EXPECT_NEAR(fit.translation.z(), 0.1, 1e-3);
  EXPECT_NEAR((fit.rotation * Eigen::Vector3d::UnitZ()).z(), std::cos(0.05), 1e-9);
}

}  // namespace
}  // namespace clearway
