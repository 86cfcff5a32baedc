// What the beams of a sparse sensor leave out of an object.
#include "scene/sparse_sight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/frames.h"

namespace clearway {
namespace {

using testing_support::AddObject;
using testing_support::BoxSurface;
using testing_support::FrameAt;

constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr double kSensorUp_m = 1.7;

// As it is after one frame, straight ahead of a sensor at the origin and as high as that.
MovingObject Seen(double ahead_m, const std::vector<Eigen::Vector3d>& points_B) {
  ThreadPool pool(1);
  SceneBuilder builder({}, {}, pool);
  Frame frame = FrameAt(0);
  AddObject(frame, 1, Pose::Translation(ahead_m, 0, kSensorUp_m), points_B);
  EXPECT_TRUE(builder.Apply(frame).ok());
  return *builder.Publish()->FindObject(1);
}

// Rays to far behind it, all from one place, a row of them each so many degrees.
LabelledCloud Rows(double apart_deg, const Eigen::Vector3d& origin_W) {
  constexpr double kUp_deg = 20, kAside_deg = 10, kFar_m = 60;
  LabelledCloud cloud;
  cloud.origins_W = {origin_W.cast<float>()};
  for (double up_deg = -kUp_deg; up_deg <= kUp_deg; up_deg += apart_deg) {
    for (double aside_deg = -kAside_deg; aside_deg <= kAside_deg; aside_deg += 0.2) {
      const double up_rad = up_deg * kDegree_rad, aside_rad = aside_deg * kDegree_rad;
      const Eigen::Vector3d way_W(std::cos(up_rad) * std::cos(aside_rad),
                                  std::cos(up_rad) * std::sin(aside_rad), std::sin(up_rad));
      cloud.ends_W.push_back((origin_W + kFar_m * way_W).cast<float>());
      cloud.kinds.push_back(RayEnd::kBlock);
      cloud.labels.push_back(kStaticLabel);
    }
  }
  return cloud;
}

class BeamsApartTest : public testing::Test {
 protected:
  const std::vector<Eigen::Vector3d> pedestrian_ = BoxSurface({0.5, 0.5, 1.75}, 0.05);
  const Eigen::Vector3d sensor_W_{0, 0, kSensorUp_m};
};

TEST_F(BeamsApartTest, AreAnAngleByTheSensorAndALengthAtTheObject) {
  for (const double apart_deg : {0.3, 1.0}) {
    for (const double ahead_m : {8.0, 16.0}) {
      const BeamsApart dut =
          BeamsApartAt(Seen(ahead_m, pedestrian_), Rows(apart_deg, sensor_W_), Time(), {});
      EXPECT_NEAR(dut.rad, apart_deg * kDegree_rad, 1e-3) << ahead_m;
      EXPECT_NEAR(dut.m, apart_deg * kDegree_rad * ahead_m, 0.01) << ahead_m;
    }
  }
}

// Wherever the frame's origin is: it is measured from where rays begin.
TEST_F(BeamsApartTest, AreMeasuredFromWhereRaysBegin) {
  const Eigen::Vector3d nearer_W(8, 0, kSensorUp_m);
  const BeamsApart dut = BeamsApartAt(Seen(16, pedestrian_), Rows(1, nearer_W), Time(), {});
  EXPECT_NEAR(dut.m, kDegree_rad * 8, 0.01);
}

// What a rail before it hides is no gap between beams.
TEST_F(BeamsApartTest, AreNoFartherApartBecauseARailHidesSome) {
  LabelledCloud cloud = Rows(0.3, sensor_W_);
  for (Eigen::Vector3f& end_W : cloud.ends_W) {
    const float up_m = end_W.z() - static_cast<float>(kSensorUp_m);
    if (up_m < 0 && up_m > -4) end_W = cloud.origins_W[0] + 0.1F * (end_W - cloud.origins_W[0]);
  }
  const BeamsApart dut = BeamsApartAt(Seen(10, pedestrian_), cloud, Time(), {});
  EXPECT_NEAR(dut.rad, 0.3 * kDegree_rad, 1e-3);
}

TEST_F(BeamsApartTest, AreNotKnownWhereNoneComeThrough) {
  const MovingObject object = Seen(10, pedestrian_);
  const LabelledCloud elsewhere = Rows(0.3, sensor_W_ + Eigen::Vector3d(0, 20, 0));
  EXPECT_EQ(BeamsApartAt(object, elsewhere, Time(), {}).m, 0);
  EXPECT_EQ(BeamsApartAt(object, {}, Time(), {}).m, 0);
}

TEST(ShareOfHeightsMissedTest, IsOfTheLayersBetweenTheLowestAndTheHighestHit) {
  const double voxel_m = SceneParams{}.object_resolution_m;
  std::vector<Eigen::Vector3d> ring;
  for (const Eigen::Vector3d& p : BoxSurface({0.5, 0.5, 0}, voxel_m)) ring.push_back(p);
  const auto with_rings_each = [&](double apart_m) {
    std::vector<Eigen::Vector3d> points_B;
    for (int i = 0; i < 5; ++i) {
      for (const auto& p : ring) points_B.push_back(p + Eigen::Vector3d(0, 0, i * apart_m));
    }
    return ShareOfHeightsMissed(Seen(10, points_B));
  };
  EXPECT_EQ(with_rings_each(voxel_m), 0);
  EXPECT_NEAR(with_rings_each(2 * voxel_m), 4.0 / 9, 1e-9);
  EXPECT_NEAR(with_rings_each(4 * voxel_m), 12.0 / 17, 1e-9);
}

}  // namespace
}  // namespace clearway
