#include "clearway/report/box_fit.h"

#include <gtest/gtest.h>

namespace clearway {
namespace {

constexpr double kTurn_rad = 0.5;

// The box of object 7, turned, at x = t metres; those of others are not known.
Truth OneBox() {
  Truth truth;
  truth.end = Time(std::chrono::seconds(100));
  truth.boxes = [](Time t) {
    Pose T_W_B = Pose::Translation(ToSeconds(t - Time()), 0, 0);
    T_W_B.rotation = Eigen::AngleAxisd(kTurn_rad, Eigen::Vector3d::UnitZ());
    return std::vector<TrueBox>{{7, {4, 2, 1.5}, T_W_B}};
  };
  return truth;
}

// Objects whose frames are that of the box, up to a shift, with the voxels that hold these points.
SceneSnapshot SceneWith(const std::vector<ObjectId>& ids,
                        const std::vector<Eigen::Vector3d>& points_B, int second) {
  SceneSnapshot scene = SceneSnapshot::Empty({});
  scene.stamp = Time(std::chrono::seconds(second));
  const Pose T_B_O = Pose::Translation(0.5, 0.2, 0);
  VoxelMap map_O(0.1);
  for (const Eigen::Vector3d& p_B : points_B) {
    map_O.Set(map_O.grid().KeyOf(Inverse(T_B_O) * p_B), 1000);
  }
  for (const ObjectId id : ids) {
    MovingObject object;
    object.id = id;
    object.history = {{scene.stamp, OneBox().boxes(scene.stamp)[0].T_W_B * T_B_O}};
    object.first_seen = object.last_seen = scene.stamp;
    scene.objects.push_back(std::make_shared<const MovingObject>(WithMap(object, map_O)));
  }
  return scene;
}

TEST(BoxFitter, MeasuresAlongTheAxesOfTheTrueBox) {
  BoxFitter dut(OneBox());
  dut.Add(SceneWith({7, 8}, {{-1.95, 0.95, 0.05}, {1.75, -0.85, 0.65}}, 1));
  const auto fits = dut.Fits();
  ASSERT_EQ(fits.size(), 1u);
  const BoxFit& fit = fits.at(7);
  EXPECT_EQ(fit.true_m, Eigen::Vector3d(4, 2, 1.5));
  EXPECT_LT((fit.mapped_m - Eigen::Vector3d(3.7, 1.8, 0.6)).norm(), 1e-6) << fit.mapped_m;
  EXPECT_NEAR(fit.WorstDifference_m(), 0.9, 1e-6);
}

TEST(BoxFitter, JudgesNoBoxWithoutASize) {
  Truth truth = OneBox();
  truth.boxes = [](Time t) {
    return std::vector<TrueBox>{{7, Eigen::Vector3d::Zero(), OneBox().boxes(t)[0].T_W_B}};
  };
  BoxFitter dut(truth);
  dut.Add(SceneWith({7}, {{0.05, 0.05, 0.05}}, 1));
  EXPECT_TRUE(dut.Fits().empty());
}

TEST(BoxFitter, TakesTheNewestMap) {
  BoxFitter dut(OneBox());
  dut.Add(SceneWith({7}, {{-0.05, 0.05, 0.05}, {0.25, 0.05, 0.05}}, 1));
  SceneSnapshot later = SceneWith({7}, {{-0.05, 0.05, 0.05}, {0.95, 0.05, 0.05}}, 2);
  dut.Add(later);
  EXPECT_NEAR(dut.Fits().at(7).mapped_m.x(), 1, 1e-6);
  later.objects.clear();
  dut.Add(later);
  EXPECT_EQ(dut.Fits().size(), 1u);
}

TEST(BoxFitter, WithoutVoxelsThereIsNoFit) {
  BoxFitter dut(OneBox());
  dut.Add(SceneWith({7}, {}, 1));
  EXPECT_TRUE(dut.Fits().empty());
}

}  // namespace
}  // namespace clearway
